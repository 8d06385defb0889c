"""Starts programs with a limit of time and memory, and ends those that still run when this program must end."""

import os
import signal
import subprocess

MEMORY = 16 << 30  # bytes of address space: a fault may allocate without end
groups = set()  # of the processes that run


def end_group(group):
    try:
        os.killpg(group, signal.SIGKILL)
    except ProcessLookupError:
        pass


def end_all(*_):
    for group in list(groups):
        end_group(group)
    os._exit(1)


signal.signal(signal.SIGTERM, end_all)


def run(command, folder, environment, seconds=None):
    """Returns the exit status and the output. After the given time, ends the program and all that it started."""
    # What a shell starts in the background ignores SIGINT, and Python's tests of Ctrl+C would wait for ever.
    limited = ["env", "--default-signal=INT", "prlimit", f"--as={MEMORY}", "--core=0", "--", *map(str, command)]
    process = subprocess.Popen(limited, cwd=folder, env=environment, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                               stderr=subprocess.STDOUT, text=True, errors="replace", start_new_session=True)
    groups.add(process.pid)
    try:
        output, _ = process.communicate(timeout=seconds)
    except subprocess.TimeoutExpired:
        end_group(process.pid)
        output, _ = process.communicate()
    finally:
        end_group(process.pid)  # what a test left running
        groups.discard(process.pid)
    return process.returncode, output
