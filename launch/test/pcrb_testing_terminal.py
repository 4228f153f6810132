"""A user's terminal: programs that have one, and keys that are pressed on it."""
import contextlib
import os
import pty
import re
import select

from pcrb_testing_wait import LIMIT, wait_until

CTRL_C = '\x03'


class Terminal:
    """A program with a terminal of its own, which hangs up when this ends."""

    def __init__(self, command, **variables):
        self.text = ''  # all that it has shown
        self._seen = 0
        self._pid, self._descriptor = pty.fork()
        if self._pid == 0:
            os.environ.update(variables)
            os.execvp(command[0], command)

    def press(self, keys):
        os.write(self._descriptor, keys.encode())

    def wait_for(self, pattern):
        """Until a regular expression matches what came after its last match."""
        def found():
            is_open = self._read()
            match = re.search(pattern, self.text[self._seen:])
            assert match or is_open, f'ended without showing {pattern}:\n{self.text}'
            self._seen += match.end() if match else 0
            return match
        wait_until(found, f'the terminal shows {pattern}')

    def wait(self, limit=LIMIT):
        """The program's exit status, as a shell has it."""
        wait_until(lambda: not self._read(), f'the program ends: {self.text}', limit)
        os.close(self._descriptor)
        _, status = os.waitpid(self._pid, 0)
        return 128 + os.WTERMSIG(status) if os.WIFSIGNALED(status) else os.WEXITSTATUS(status)

    def _read(self):
        """Whether there may be more."""
        if not select.select([self._descriptor], [], [], 0.1)[0]:
            return True
        data = b''
        with contextlib.suppress(OSError):  # the end of a terminal
            data = os.read(self._descriptor, 65536)
        self.text += data.decode(errors='replace')
        return bool(data)
