"""The processes of this machine, for tests that ask what runs, or what is left."""
import contextlib
import os


def command_lines():
    """Of all processes but this one, by their ids: their words, each with a \\0 behind it."""
    found = {}
    for pid in filter(str.isdigit, os.listdir('/proc')):
        with contextlib.suppress(OSError):  # it has ended, or is another user's
            with open(f'/proc/{pid}/cmdline', 'rb') as line:
                found[int(pid)] = os.fsdecode(line.read())
    found.pop(os.getpid(), None)
    return found


def processes_that_name(text):
    """Ids of those with a text in their command line."""
    return [pid for pid, line in command_lines().items() if text in line]


def marked_processes(mark):
    """Command lines of those that have PCRB_MARK=mark in their environment, by their ids."""
    found = {}
    for pid, line in command_lines().items():
        with contextlib.suppress(OSError):
            with open(f'/proc/{pid}/environ', 'rb') as environment:
                if f'PCRB_MARK={mark}\0'.encode() in environment.read():
                    found[pid] = line
    return found
