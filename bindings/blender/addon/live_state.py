# SPDX-License-Identifier: GPL-3.0-or-later
"""What a run of Fair Live has changed so far, which change the pointer is at, and what was before: plain data."""

import math
from dataclasses import dataclass, field, replace

import numpy as np

from .live_edits import BULGE, MOVE, TILT, TWIST, WIDEST, Edit

STEP = math.radians(5)
_GROWTH = 1.2
# The first reach of a move, in edges of the loop.
_FIRST_REACH = 4.0


@dataclass
class LiveState:
    """Edits by kind and vertex; the one at hand is `kind` at `vertex` of `loop`."""

    loop: object
    vertex: int
    kind: str = TILT
    axes: tuple = ()
    edits: dict = field(default_factory=dict)
    _before: list = field(default_factory=list)

    @property
    def key(self):
        return self.kind, -1 if self.kind == BULGE else self.vertex

    @property
    def current(self):
        return self.edits.get(self.key) or Edit(*self.key)

    @current.setter
    def current(self, edit):
        self.edits[self.key] = edit

    def remember(self):
        """What follows can be taken back."""
        now = (dict(self.edits), self.axes, self.loop, self.vertex, self.kind)
        if not self._before or self._before[-1][:2] != now[:2]:
            self._before.append(now)

    def take_back(self):
        """The state before the last change; False: there was none."""
        while self._before and self._before[-1][:2] == (self.edits, self.axes):
            self._before.pop()
        if not self._before:
            return False
        edits, self.axes, self.loop, self.vertex, self.kind = self._before[-1]
        self.edits = dict(edits)
        return True

    def choose(self, kind):
        self.remember()
        self.kind = MOVE if self.loop.is_point and kind in (TILT, TWIST) else kind

    def pick(self, loop, vertex):
        """Goes on at another vertex; where the whole loop is edited alike already, that goes on."""
        self.remember()
        for key, edit in self.edits.items():
            if key[0] == self.kind and key[1] in loop.vertices and edit.falloff == 0.0:
                vertex = key[1]
        self.loop, self.vertex = loop, vertex
        self.choose(self.kind)

    def turn(self, start, angle, in_steps):
        """Sets the angle to so much beyond that of the edit `start`."""
        angle = start.angle + angle
        if in_steps:
            angle = STEP * round(angle / STEP)
        self.current = replace(self.current, angle=float(np.clip(angle, -WIDEST, WIDEST)))

    def widen(self, is_wider, edge, size):
        """Makes the reach larger or smaller; `edge`: the loop's mean edge as seen in the scene, `size`: that of its unit."""
        if self.kind == BULGE or self.loop.is_point:
            return
        now, whole = self.current.falloff, size * self.loop.length
        if self.kind == MOVE:
            if is_wider:
                now = now * _GROWTH or _FIRST_REACH * edge
            else:
                now = now / _GROWTH if now > edge else 0.0
        elif is_wider:
            # To the whole loop.
            now = now * _GROWTH if 0.0 < now * _GROWTH < whole / 2 else 0.0
        else:
            now = max(now / _GROWTH, 2 * edge) if now else whole / 2
        self.current = replace(self.current, falloff=now)

    def weights(self, size):
        """How much of the edit each vertex of the loop gets, about, (k,)."""
        if self.kind in (BULGE, MOVE) or self.current.falloff == 0.0:
            return np.ones(len(self.loop.vertices))
        share = np.clip(size * np.abs(self.loop.distances(self.vertex)) / self.current.falloff, 0, 1)
        return (1 - share**2) ** 2


NAMES = {TILT: "Tilt", TWIST: "Twist", BULGE: "Bulge", MOVE: "Move"}
