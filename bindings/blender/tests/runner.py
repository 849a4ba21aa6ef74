# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs the functions test_* of a module one after the other, each in an empty scene, and ends the process.

Blender's Python has no pytest. The exit code is 0 only if tests have run and all have passed; the last line says how many.
"""

import faulthandler
import os
import sys
import time
import traceback

import common


def run(module):
    only = os.environ.get("FAIRMESH_ONLY", "")
    tests = [(name, f) for name, f in vars(module).items() if name.startswith("test_") and callable(f) and only in name]
    failed = 0
    # A test that hangs says where.
    faulthandler.dump_traceback_later(int(os.environ.get("FAIRMESH_SECONDS", "400")), exit=True)
    for name, test in tests:
        common.clear()
        start = time.process_time()
        try:
            test()
            print(f"ok      {name} ({time.process_time() - start:.1f} s)", flush=True)
        except BaseException:
            failed += 1
            traceback.print_exc()
            print(f"FAILED  {name}", flush=True)
    print(f"{len(tests) - failed} of {len(tests)} tests have passed", flush=True)
    # Not sys.exit: Blender would go on.
    common.leave(0 if tests and not failed else 1)


def raises(function, *parts):
    """The message of the RuntimeError that an operator raises when it reports an error; it has all the parts."""
    try:
        function()
    except RuntimeError as why:
        message = str(why)
        missing = [part for part in parts if part not in message]
        assert not missing, f"{message!r} has not {missing}"
        return message
    raise AssertionError("no error was reported")


def arguments():
    """What comes after "--" where Blender was started, or the script's own arguments."""
    return sys.argv[sys.argv.index("--") + 1 :] if "--" in sys.argv else sys.argv[1:]
