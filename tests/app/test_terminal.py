import os
import pty
import select
import signal
import subprocess
import time

import support
from support import INTERRUPTED, NOT_CONVERGED, WINSLOW, ProgramTest

# So little of each step is taken that the solver is busy for as long as a test may need.
SLOW = ("--formulation", "pointwise", "--outer", "picard", "--damping", "1e-9", "--fixed-damping", "--acceleration", "0", "--max-iterations")


class Terminal(ProgramTest):
    def on_terminal(self, *args):
        """Output of a run whose standard error is a terminal."""
        try:
            master, slave = pty.openpty()
        except OSError as error:  # a chroot without /dev/pts
            self.skipTest(str(error))
        with subprocess.Popen([WINSLOW, *args], cwd=self.folder, stderr=slave,
                              stdout=subprocess.DEVNULL) as run:
            os.close(slave)
            text = b""
            while True:
                ready, _, _ = select.select([master], [], [], 60)
                try:
                    data = os.read(master, 65536) if ready else b""
                except OSError:  # the other end is closed
                    data = b""
                if not data:
                    break
                text += data
            os.close(master)
        return text.decode()

    def test_progress_line_on_a_terminal(self):
        self.ring()
        text = self.on_terminal("move", "ring.su2", "-o", "o.su2", "--marker", "body", "--rotate",
                                "20")
        self.assertIn("Rotate body by 20 deg: iteration", text)
        self.assertIn("residual", text)
        self.assertTrue(text.endswith("\r\x1b[K"), repr(text[-40:]))  # and it is wiped off

    def test_none_with_quiet_and_none_in_a_pipe(self):
        self.ring()
        args = ("move", "ring.su2", "-o", "o.su2", "--marker", "body", "--rotate", "20")
        self.assertEqual(self.on_terminal(*args, "--quiet"), "")
        self.assertEqual(self.winslow(*args).stderr, "")


class Signals(ProgramTest):
    def start(self, *args):
        return subprocess.Popen([WINSLOW, *args], cwd=self.folder, text=True,
                                stdout=subprocess.PIPE, stderr=subprocess.PIPE)

    def interrupt(self, number):
        self.ring(around=96, rings=48)
        self.path("o.su2").write_text("precious")
        run = self.start("smooth", "ring.su2", "-o", "o.su2", "--report", "r.json", "--history",
                         "h.csv", "--save-recipe", "s.json", *SLOW, "100000000")
        time.sleep(1.0)
        self.assertIsNone(run.poll(), "it ended before it could be interrupted")
        start = time.monotonic()
        run.send_signal(number)
        _, errors = run.communicate(timeout=30)
        self.assertEqual(run.returncode, INTERRUPTED)
        self.assertIn("interrupted; nothing was written", errors)
        self.assertLess(time.monotonic() - start, 20)
        self.assertEqual(self.path("o.su2").read_text(), "precious")
        self.assertEqual(self.files(), ["o.su2", "ring.su2"])

    def test_ctrl_c(self):
        self.interrupt(signal.SIGINT)

    def test_terminate(self):
        self.interrupt(signal.SIGTERM)

    def test_the_same_job_ends_by_itself_without_a_signal(self):
        self.ring()
        self.winslow("smooth", "ring.su2", "-o", "o.su2", *SLOW, "50", code=NOT_CONVERGED)
        self.assertIn("o.su2", self.files())


if __name__ == "__main__":
    support.main()
