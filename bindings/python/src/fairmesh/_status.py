"""Why a call was refused."""

from __future__ import annotations

import enum


class Status(enum.IntEnum):
    """Why a call was refused, as numbered by the C interface."""

    #: Done.
    OK = 0
    #: A pointer is NULL that may not be. Element: the argument.
    NULL_POINTER = 1
    #: A pointer or a stride does not have the alignment of what it points to. Element: the argument.
    MISALIGNED = 2
    #: ``struct_size`` is not one that this library knows. Element: the argument.
    BAD_STRUCT_SIZE = 3
    #: A number in the options is out of its range. Element: the argument and the field.
    BAD_OPTION = 4
    #: A number is not one of the enumeration that is meant. Element: the argument and the field.
    BAD_ENUM = 5
    #: A stride is smaller than what it steps over. Element: the argument and the field.
    BAD_STRIDE = 6
    #: A count times its stride exceeds the address space. Element: the argument and the field.
    COUNT_OVERFLOW = 7
    #: Two counts differ that have to be the same. Element: the argument and the field.
    COUNT_MISMATCH = 8
    #: An output overlaps an input or another output. Only positions may be written over those that were read, with
    #: the same address, stride and scalar. Element: the argument of the output.
    ALIASING = 9
    #: Not a living handle of the kind that is meant: never made, or freed before. Element: the argument.
    BAD_HANDLE = 10
    #: The handle is in use: by another thread, or by the call whose callback this call comes from.
    BUSY = 11
    #: Memory ran out. Everything that the call had allocated is free again; a solver stays usable.
    OUT_OF_MEMORY = 12
    #: The system gave no more threads.
    THREADS = 13
    #: More vertices or triangles than 32-bit indices can name.
    TOO_LARGE = 14
    #: A coordinate that is needed is NaN or infinite (or does not fit a float on its way out). Element: the vertex.
    NOT_FINITE = 15
    #: A triangle names a vertex that does not exist. Element: the triangle; other: the index.
    INDEX_OUT_OF_RANGE = 16
    #: A triangle names a vertex twice. Element: the triangle; other: the vertex.
    REPEATED_INDEX = 17
    #: Two triangles have the same vertices. Element: the later triangle; other: the earlier one.
    DUPLICATE_TRIANGLE = 18
    #: More than two triangles share an edge. Element: the edge.
    NON_MANIFOLD_EDGE = 19
    #: The triangles around a vertex are not one fan. Element: the vertex.
    NON_MANIFOLD_VERTEX = 20
    #: Two triangles run through an edge in the same direction. Element: the edge.
    INCONSISTENT_ORIENTATION = 21
    #: A free vertex is on the boundary of the mesh. Element: the vertex.
    FREE_VERTEX_ON_BOUNDARY = 22
    #: A free vertex has no triangle. Element: the vertex.
    FREE_VERTEX_WITHOUT_TRIANGLE = 23
    #: A component of the region has no fixed vertex. Element: the free vertex with the smallest index in it.
    NOTHING_FIXED = 24
    #: No vertex is free.
    EMPTY_REGION = 25
    #: The selection names what does not exist. Element: what it names, a vertex, triangle or loop.
    SELECTION_OUT_OF_RANGE = 26
    #: A normal is not a finite vector of length one (to 0.001). Element: the vertex.
    BAD_NORMAL = 27
    #: No normal can be found for a boundary vertex: give one. Element: the vertex.
    NO_NORMAL = 28
    #: The result has nothing of this kind, or nothing with this index.
    NOT_AVAILABLE = 29
    #: The buffer is too small; the size needed has been told.
    BUFFER_TOO_SMALL = 30
    #: A number is not what this version asks for: reserved fields have to be zero. Element: the argument and the
    #: field.
    BAD_RESERVED = 31
    #: A bug of fairmesh, caught. The handle, if there was one, answers INTERNAL from now on; free it.
    INTERNAL = 99
