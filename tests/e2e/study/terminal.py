# SPDX-FileCopyrightText: 2026 The Hapnet authors
# SPDX-License-Identifier: MIT
"""hapnet-study at a terminal of its own, for the tests. HAPNET_REPOSITORY is the clone."""

import os
import pty
import select
import subprocess
import sys
import time

PROGRAM = os.path.join(os.environ["HAPNET_REPOSITORY"], "python/hapnet-study")
WITHIN_S = 100.0


class Terminal:
    """The program at a terminal of its own."""

    def __init__(self, *words):
        ours, theirs = pty.openpty()
        self.process = subprocess.Popen(
            [sys.executable, PROGRAM, *words], stdin=theirs, stdout=theirs, stderr=theirs,
            start_new_session=True)
        os.close(theirs)
        self._ours, self.said = ours, ""
        self._is_at_its_end = False

    def until(self, *texts):
        """Waits for one of these texts after what was read so far; returns it, or "" at the end."""
        end = time.monotonic() + WITHIN_S
        fresh = ""
        while time.monotonic() < end:
            for text in texts:
                if text in fresh:
                    self.said += fresh
                    return text
            if not select.select([self._ours], [], [], 0.5)[0]:
                continue
            try:
                chunk = os.read(self._ours, 1)
            except OSError:  # nobody is at the other side
                chunk = b""
            if not chunk:
                self.said += fresh
                self._is_at_its_end = True
                return ""
            fresh += chunk.decode(errors="replace")
        raise AssertionError(f"none of {texts} came: {self.said}{fresh}")

    def type(self, text):
        os.write(self._ours, text.encode())

    def close(self):
        """Ends the program, if it has not ended; returns its exit code."""
        if self._is_at_its_end:
            code = self.process.wait(WITHIN_S)
        else:
            self.process.kill()
            code = self.process.wait()
        os.close(self._ours)
        return code
