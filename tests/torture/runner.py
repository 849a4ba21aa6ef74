"""Runs programs one by one with a limit in CPU seconds, from a process so small that it does not blur peak memory.

As a program it reads one JSON request per line and answers with one line; `Runner` talks to it.
"""

import json
import os
import subprocess
import sys
import time

# A run whose CPU time is not used up may still hang: then it ends after so many times its limit on the clock.
CLOCK_FACTOR = 20


class Runner:
    """A child process that runs programs."""

    def __init__(self):
        self.process = subprocess.Popen(
            [sys.executable, "-S", "-E", __file__], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True
        )

    def run(self, command, cpu_seconds):
        """The exit code (negative: a signal), CPU seconds, peak kilobytes, and what was printed."""
        request = {"command": [str(word) for word in command], "cpu": cpu_seconds}
        self.process.stdin.write(json.dumps(request) + "\n")
        self.process.stdin.flush()
        return json.loads(self.process.stdout.readline())


def run(command, cpu):
    import resource
    import signal
    import tempfile

    def limits():
        resource.setrlimit(resource.RLIMIT_CPU, (cpu, cpu + 1))
        resource.setrlimit(resource.RLIMIT_CORE, (0, 0))

    begin = time.monotonic()
    with tempfile.TemporaryFile() as printed:
        child = subprocess.Popen(
            command, stdin=subprocess.DEVNULL, stdout=printed, stderr=subprocess.STDOUT, preexec_fn=limits
        )
        signal.signal(signal.SIGALRM, lambda *_: child.kill())
        signal.alarm(CLOCK_FACTOR * cpu)
        _, status, usage = os.wait4(child.pid, 0)
        signal.alarm(0)
        child.returncode = os.waitstatus_to_exitcode(status)
        printed.seek(0)
        text = printed.read(4000).decode("utf-8", "replace")
    seconds = usage.ru_utime + usage.ru_stime
    clock = time.monotonic() - begin
    killed = child.returncode == -signal.SIGKILL and (seconds >= cpu or clock >= CLOCK_FACTOR * cpu)
    hang = killed or child.returncode == -signal.SIGXCPU
    return {"code": child.returncode, "cpu": seconds, "kilobytes": usage.ru_maxrss, "text": text, "hang": hang}


def main():
    for line in sys.stdin:
        request = json.loads(line)
        print(json.dumps(run(request["command"], request["cpu"])), flush=True)


if __name__ == "__main__":
    main()
