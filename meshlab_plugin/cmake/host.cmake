# SPDX-License-Identifier: MIT OR Apache-2.0
# Finds out what the program was built as, from its library, and that the sources are those of the same version. The loader of MeshLab
# compares the same, but a plugin that does not match crashes it, or is refused without a word.
# Sets MESHLAB_API (2020 or 2022), MESHLAB_SCALAR, MESHLAB_VCGLIB, MESHLAB_DEFINITIONS.

if(NOT EXISTS "${MESHLAB_LIBRARY}")
    message(FATAL_ERROR "MESHLAB_LIBRARY: there is no file '${MESHLAB_LIBRARY}'. It has to be the program's libmeshlab-common.so.")
endif()
if(NOT EXISTS "${MESHLAB_SOURCE}/ML_VERSION")
    message(FATAL_ERROR "MESHLAB_SOURCE: '${MESHLAB_SOURCE}' is not MeshLab's source tree (no ML_VERSION).")
endif()

# Sources of another release that has the same types are those of this one: hosts.sh says where that is so.
set(MESHLAB_RELEASE "" CACHE STRING "the program's version, if the sources are of another one with the same types")

# The version, such as 2025.07: in the library as text, with a d behind it if its numbers are doubles.
file(READ "${MESHLAB_SOURCE}/ML_VERSION" source_version)
string(REGEX MATCH "20[0-9][0-9]\\.[0-9][0-9]" source_version "${source_version}")
if(NOT MESHLAB_RELEASE STREQUAL "")
    set(source_version "${MESHLAB_RELEASE}")
endif()
file(STRINGS "${MESHLAB_LIBRARY}" library_versions REGEX "20[0-9][0-9]\\.[0-9][0-9]")
string(REGEX MATCHALL "20[0-9][0-9]\\.[0-9][0-9]" library_versions "${library_versions}")
list(REMOVE_DUPLICATES library_versions)
if(NOT source_version IN_LIST library_versions)
    message(FATAL_ERROR "The sources are those of MeshLab ${source_version}, but ${MESHLAB_LIBRARY} is of version '${library_versions}'. "
        "The loader would refuse the plugin. Take the sources of the same version.")
endif()

# The scalar: in the mangled name of a function that takes a matrix of it.
execute_process(COMMAND "${CMAKE_NM}" -D --defined-only "${MESHLAB_LIBRARY}"
    OUTPUT_VARIABLE library_symbols RESULT_VARIABLE failed ERROR_VARIABLE why)
if(failed)
    message(FATAL_ERROR "${CMAKE_NM} cannot read ${MESHLAB_LIBRARY}: ${why}")
endif()
if(library_symbols MATCHES "setMeshTransformationMatrixEiRKN3vcg8Matrix44IdEE")
    set(library_scalar double)
elseif(library_symbols MATCHES "setMeshTransformationMatrixEiRKN3vcg8Matrix44IfEE")
    set(library_scalar float)
else()
    message(FATAL_ERROR "${MESHLAB_LIBRARY} is not MeshLab's common library, or one that this plugin does not know.")
endif()
if(MESHLAB_SCALAR STREQUAL "")
    set(MESHLAB_SCALAR ${library_scalar})
elseif(NOT MESHLAB_SCALAR STREQUAL library_scalar)
    message(FATAL_ERROR "MESHLAB_SCALAR is ${MESHLAB_SCALAR}, but ${MESHLAB_LIBRARY} was built with ${library_scalar}. "
        "The loader would refuse the plugin.")
endif()

# The plugin interface.
if(EXISTS "${MESHLAB_SOURCE}/src/common/interfaces.h")
    set(MESHLAB_API 2020)
    set(MESHLAB_VCGLIB "${MESHLAB_SOURCE}/vcglib")
    set(MESHLAB_DEFINITIONS FAIRMESH_MESHLAB_2020)
elseif(EXISTS "${MESHLAB_SOURCE}/src/common/plugins/interfaces/filter_plugin.h")
    set(MESHLAB_API 2022)
    set(MESHLAB_VCGLIB "${MESHLAB_SOURCE}/src/vcglib")
    set(MESHLAB_DEFINITIONS MESHLAB_VERSION=${source_version})
    if(MESHLAB_SCALAR STREQUAL double)
        set(MESHLAB_DEFINITIONS MESHLAB_VERSION=${source_version}d)
    endif()
else()
    message(FATAL_ERROR "${MESHLAB_SOURCE} has neither the plugin interface of 2020.09 nor that of 2022.02 and later.")
endif()
if(NOT EXISTS "${MESHLAB_VCGLIB}/vcg/complex/complex.h")
    message(FATAL_ERROR "${MESHLAB_VCGLIB} does not hold vcglib: a source tree from git needs its submodules.")
endif()
message(STATUS "MeshLab ${source_version}, ${MESHLAB_SCALAR}, plugin interface of ${MESHLAB_API}")
