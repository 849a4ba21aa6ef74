# SPDX-License-Identifier: GPL-3.0-or-later
"""A number that is typed while an operator runs, as in Blender's own transformations, whose parser Python cannot call."""

_NAMES = ("ZERO", "ONE", "TWO", "THREE", "FOUR", "FIVE", "SIX", "SEVEN", "EIGHT", "NINE")
_CHARACTERS = {
    **{name: str(digit) for digit, name in enumerate(_NAMES)},
    **{f"NUMPAD_{digit}": str(digit) for digit in range(10)},
    "PERIOD": ".",
    "NUMPAD_PERIOD": ".",
    "COMMA": ".",
    "MINUS": "-",
    "NUMPAD_MINUS": "-",
}


class NumberInput:
    """What has been typed; `value` is None where the mouse decides."""

    def __init__(self):
        self._digits = ""
        self._is_negative = False

    @property
    def is_active(self):
        return bool(self._digits) or self._is_negative

    @property
    def value(self):
        if not self.is_active:
            return None
        number = float(self._digits) if self._digits.strip(".") else 0.0
        return -number if self._is_negative else number

    @property
    def text(self):
        """As it is shown, with the place where one types."""
        return ("-" if self._is_negative else "") + self._digits + "|"

    def take(self, key):
        """Takes the name of a key that was pressed; False: it is none of a number's."""
        if key == "BACK_SPACE":
            was_active = self.is_active
            if self._digits:
                self._digits = self._digits[:-1]
            else:
                self._is_negative = False
            return was_active
        character = _CHARACTERS.get(key)
        if character is None:
            return False
        if character == "-":
            # Wherever it is pressed, as Blender does.
            self._is_negative = not self._is_negative
        elif character != "." or "." not in self._digits:
            self._digits += character
        return True

    def clear(self):
        self._digits, self._is_negative = "", False
