"""The verbs that play maps on a panel, without one: sim headless and in a window that nobody sees, and
what show says before it reaches for any wire."""

import fcntl
import json
import os
import pathlib
import pty
import signal
import subprocess
import tempfile
import termios
import threading
import time
import unittest

YAMABIKO = os.environ["YAMABIKO"]
MAPS = pathlib.Path(os.environ["YB_GALLERY"])
FUJI, DAVOS = MAPS / "fuji.yb", MAPS / "davos.yb"


def run(*words, **environment):
    environ = {name: value for name, value in os.environ.items()
               if name not in ("DISPLAY", "WAYLAND_DISPLAY", "SDL_VIDEODRIVER")}
    return subprocess.run([YAMABIKO, *map(str, words)], stdin=subprocess.DEVNULL,
                          capture_output=True, timeout=300, check=False, text=True,
                          env=environ | environment)


class Case(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def good(self, *words, **environment):
        done = run(*words, **environment)
        self.assertEqual(done.returncode, 0, f"{words}: {done.stderr}")
        return done

    def refused(self, code, sentence, *words, **environment):
        done = run(*words, **environment)
        self.assertEqual(done.returncode, code, f"{words}: {done.stderr}")
        self.assertIn(sentence, done.stderr)

    def shown(self, *words, frames=1):
        """What sim's panel shows after so many frames."""
        path = self.folder / "shown.png"
        self.good("sim", *words, "--frames", frames, "--png", path, "--force")
        return path.read_bytes()

    def rendered(self, *words):
        path = self.folder / "rendered.png"
        self.good("render", *words, "-o", path, "--force")
        return path.read_bytes()


class Panels(Case):
    def test_every_panel_shows_every_turn_as_rendered(self):
        for panel in json.loads(self.good("info", "--panel", "--json").stdout):
            for turn in (0, 90, 180, 270):
                with self.subTest(panel=panel["name"], turn=turn):
                    place = (FUJI, "--panel", panel["name"], "--turn", turn)
                    self.assertEqual(self.shown(*place, "--orbit", frames=4),
                                     self.rendered(*place, "--azimuth", 48))

    def test_info_lists_panels(self):
        text = self.good("info", "--panel", "st7789", "ssd1306").stdout
        self.assertIn("st7789 ", text)
        self.assertNotIn("ili9341", text)
        one, = json.loads(self.good("info", "--panel", "st7789", "--json").stdout)
        # 62.5 MHz, 240 x 240 pixels of 16 bits and a window's 11 bytes.
        self.assertEqual(one["frame_bytes"], 240 * 240 * 2 + 11)
        self.assertAlmostEqual(one["frames_per_second"], 62.5e6 / 8 / one["frame_bytes"],
                               places=4)
        self.refused(2, "there is no panel 'st'", "info", "--panel", "st")


class Playing(Case):
    def test_sun_and_shadows_move(self):
        self.assertEqual(
            self.shown(DAVOS, "--panel", "st7735", "--spin-sun=20", "--shadows", 64, frames=3),
            self.rendered(DAVOS, "--panel", "st7735", "--sun", 355, 30, "--shadows", 64))

    def test_slides(self):
        place = (FUJI, DAVOS, "--panel", "ssd0323", "--slide", 1, "--fps", 10)
        first, second = (self.rendered(path, "--panel", "ssd0323") for path in (FUJI, DAVOS))
        self.assertEqual(self.shown(*place, frames=10), first)
        self.assertEqual(self.shown(*place, frames=11), second)
        self.assertEqual(self.shown(*place, frames=21), first)

    def test_bands_and_whole_frames_show_the_same(self):
        place = (FUJI, "--panel", "ili9341", "--orbit")
        shown = self.shown(*place, frames=5)
        for more in (("--band", 1), ("--band", 320), ("--whole",)):
            self.assertEqual(self.shown(*place, *more, frames=5), shown)

    def test_inverted_and_dim(self):
        place = (FUJI, "--panel", "ssd1351")
        self.assertNotEqual(self.shown(*place, "--invert"), self.shown(*place))
        self.assertEqual(self.shown(*place, "--brightness", 10), self.shown(*place))

    def test_stats(self):
        said = self.good("sim", FUJI, "--panel", "st7789", "--frames", 3, "--png", os.devnull,
                         "--force", "--stats").stdout
        # A picture that stands still is sent once.
        sent = 240 * 240 * 2 + 8 * 11  # by eight bands
        self.assertEqual(said, f"3 frames, {sent} bytes, {sent // 3} bytes/frame, 33 % of whole frames\n")

    def test_record(self):
        path = self.folder / "wires.txt"
        place = (FUJI, "--panel", "st7789", "--frames", 2, "--png", os.devnull, "--force")
        self.good("sim", *place, "--record", path, "--whole")
        lines = path.read_text().splitlines()
        self.assertEqual(lines[0], "reset")
        self.assertIn("command 2c", lines)
        self.assertGreater(lines.count("command 2c"), 2 * 8)
        self.assertTrue(any(line.startswith("wait ") for line in lines))
        sent = sum(len(line.split()) - 1 for line in lines if line[0] in "cd")
        self.assertGreater(sent, 3 * 240 * 240 * 2)  # blackened, and drawn twice
        self.refused(1, "wires.txt", "sim", *place[:-1], "--record", path)

    def test_folders_and_maps_that_are_none(self):
        for name, bytes_ in (("a.yb", b"no code"), ("b.yb", FUJI.read_bytes()), ("c.txt", b"")):
            (self.folder / name).write_bytes(bytes_)
        place = (self.folder, "--panel", "ssd0323")
        done = self.good("sim", *place, "--frames", 3, "--png", self.folder / "x.png")
        self.assertEqual(done.stderr.count("a.yb"), 1, done.stderr)
        self.assertEqual((self.folder / "x.png").read_bytes(),
                         self.rendered(FUJI, "--panel", "ssd0323"))
        (self.folder / "b.yb").unlink()
        self.refused(1, "no map could be drawn", "sim", *place, "--frames", 1, "--png", os.devnull,
                     "--force")

    def test_a_folder_is_watched(self):
        def put():
            time.sleep(1)
            (self.folder / "late").write_bytes(FUJI.read_bytes())
            (self.folder / "late").rename(self.folder / "late.yb")

        (self.folder / "first.yb").write_bytes(b"no code")
        thread = threading.Thread(target=put)
        thread.start()
        # Three frames a second and a half apart: the map comes between the first and the last.
        done = self.good("sim", self.folder, "--panel", "ssd0323", "--frames", 3, "--fps", 0.7,
                         SDL_VIDEODRIVER="dummy")
        thread.join()
        self.assertEqual(done.stderr.count("first.yb"), 1, done.stderr)
        self.assertNotIn("no map", done.stderr)


class Config(Case):
    def ini(self, text):
        path = self.folder / "kiosk.ini"
        path.write_text(text)
        return path

    def test_options_from_a_file(self):
        path = self.ini(f"""; a kiosk
            [maps]
            map = {DAVOS}
            [panel]
            panel = st7735
            turn = 90
            orbit = 2
            whole = no
            [view]
            sun = 200 20
            shadows = 32
            """.replace("            ", ""))
        shown = self.shown("--config", path, frames=4)
        self.assertEqual(shown, self.rendered(DAVOS, "--panel", "st7735", "--turn", 90, "--azimuth",
                                              51, "--sun", 200, 20, "--shadows", 32))
        # The command line has the last word.
        self.assertEqual(self.shown("--config", path, "--orbit=0.5", "--shadows", 64, frames=3),
                         self.rendered(DAVOS, "--panel", "st7735", "--turn", 90, "--azimuth", 46,
                                       "--sun", 200, 20, "--shadows", 64))

    def test_the_example(self):
        # All of it is understood; there are no maps where it says.
        example = MAPS.parent / "examples/kiosk/kiosk.ini"
        self.refused(1, "/usr/local/share/yamabiko/maps", "show", "--config", example)

    def test_wrong_files(self):
        for code, sentence, text in (
                (2, "line 2: 'colour' is no option here", "panel = ssd0323\ncolour = red\n"),
                (2, "line 1 is neither", "panel\n"),
                (2, "line 1: 'panel' needs a value", "panel =\n"),
                (2, "line 1 is neither", "garbage\n\n\n\nbogus = 1\n"),
                (2, "line 2: 'bogus'", "panel = ssd0323\nbogus = 1\ngarbage\n"),
                (2, "line 2 is too long", "panel = ssd0323\nmap = " + 300 * "x" + "\n"),
                (2, "line 1: 'whole' is either yes or no", "whole = perhaps\n"),
                (2, "there is no panel 'x'", "panel = x\n"),
                (2, "line 3: 'sun' needs 2 values", "panel = ssd0323\nmap = a\nsun = 3\n")):
            with self.subTest(text=text):
                self.refused(code, sentence, "sim", "--config", self.ini(text))
        self.refused(1, "./--stats", "sim", "--config", self.ini("panel = ssd0323\n  map = --stats\n"),
                     "--frames", 1, "--png", os.devnull, "--force")
        self.refused(2, "there is no panel 'x'", "sim", "--conf", self.ini("panel = x"))
        self.refused(1, "nowhere.ini", "sim", "--config", self.folder / "nowhere.ini")


class Handheld(Case):
    def test_it_is_the_firmware(self):
        self.assertEqual(self.shown(FUJI), self.rendered(
            FUJI, "--panel", "ssd0323", "--azimuth", 0, "--exaggerate", 2))
        self.assertIn("slot=ok map=slot", self.good("sim", FUJI, "--frames", 1, "--png", os.devnull,
                                                    "--force").stdout)

    def test_built_in_map(self):
        said = self.good("sim", "--frames", 2, "--png", os.devnull, "--force").stdout
        self.assertIn("slot=empty map=built-in", said)

    def test_options_that_it_has_not(self):
        self.refused(2, "view of its own", "sim", FUJI, "--azimuth", 3)
        self.refused(2, "view of its own", "sim", FUJI, "--orbit")
        self.refused(2, "view of its own", "sim", FUJI, "--stats")
        self.refused(2, "one map", "sim", FUJI, DAVOS)
        self.refused(2, "'--png -'", "sim", FUJI, "--frames", 1, "--png", "-")
        broken = self.folder / "broken.yb"
        broken.write_bytes(b"no code")
        self.refused(1, "broken.yb", "sim", broken, "--frames", 1, "--png", os.devnull, "--force")
        self.refused(1, "nowhere.yb", "sim", "nowhere.yb", "--frames", 1, "--png", os.devnull,
                     "--force")


class Window(Case):
    def test_window(self):
        for words in ((FUJI, "--panel", "st7789", "--orbit", "--fast"), (FUJI,),
                      (FUJI, "--panel", "ls013b7dh03", "--orbit", "--scale", 2)):
            self.good("sim", *words, "--frames", 3, SDL_VIDEODRIVER="dummy")

    def test_no_desktop(self):
        self.refused(1, "no window can be opened here", "sim", FUJI, "--panel", "st7789",
                     SDL_VIDEODRIVER="no such driver")


class Terminal(Case):
    """show, while it waits for a panel that is not there."""

    WORDS = ("show", FUJI, "--panel", "st7789", "--bus", "gpiod", "--gpiochip", "gpiochip987",
             "--sck", 1, "--mosi", 2, "--cs", 3, "--dc", 4, "--retry")

    def play(self, end):
        """Runs it on a terminal, ends it by `end`, and answers its exit code."""
        master, slave = pty.openpty()
        before = termios.tcgetattr(slave)
        process = subprocess.Popen([YAMABIKO, *map(str, self.WORDS)], stdin=slave,
                                   stdout=subprocess.DEVNULL, stderr=subprocess.PIPE,
                                   start_new_session=True,
                                   preexec_fn=lambda: fcntl.ioctl(0, termios.TIOCSCTTY, 0))
        self.assertIn(b"gpiochip987", process.stderr.readline())
        self.assertIn(b"trying again in 1 s", process.stderr.readline())
        self.assertNotEqual(termios.tcgetattr(slave), before)
        end(master, process)
        status = process.wait(timeout=10)
        self.assertEqual(termios.tcgetattr(slave), before)
        process.stderr.close()
        os.close(master)
        os.close(slave)
        return status

    def test_a_key_ends_it(self):
        self.assertEqual(self.play(lambda master, process: os.write(master, b"q")), 0)

    def test_signals_end_it(self):
        for number in (signal.SIGINT, signal.SIGTERM, signal.SIGQUIT, signal.SIGHUP):
            self.assertEqual(self.play(lambda master, process: process.send_signal(number)), 0)


class Wrong(Case):
    def test_frames_are_counted(self):
        # Also those that differ in nothing.
        self.good("sim", FUJI, "--panel", "st7789", "--frames", 3, SDL_VIDEODRIVER="dummy")

    def test_standard_input_is_read_once(self):
        done = subprocess.run([YAMABIKO, "sim", "-", "--panel", "ssd0323", "--slide", "0.1",
                               "--frames", "30", "--png", self.folder / "x.png"],
                              input=FUJI.read_bytes(), capture_output=True, timeout=60, check=False)
        self.assertEqual((done.returncode, done.stderr), (0, b""))
        self.refused(1, "only map", "sim", "-", FUJI, "--panel", "ssd0323", "--frames", 1, "--png",
                     os.devnull, "--force")

    def test_pipes_in_folders_are_passed_over(self):
        os.mkfifo(self.folder / "a.yb")
        (self.folder / "b.yb").write_bytes(FUJI.read_bytes())
        self.assertEqual(self.shown(self.folder, "--panel", "ssd0323"),
                         self.rendered(FUJI, "--panel", "ssd0323"))

    def test_usage(self):
        wires = ("--bus", "gpiod", "--sck", 1, "--mosi", 2, "--cs", 3, "--dc", 4)
        for sentence, *words in (
                ("name a code", "sim", "--panel", "st7789"),
                ("there is no panel 'x'", "sim", FUJI, "--panel", "x"),
                ("fixes size and format", "sim", FUJI, "--panel", "st7789", "--size", "9x9"),
                ("--turn", "sim", FUJI, "--panel", "st7789", "--turn", 45),
                ("--orbit places the eye", "sim", FUJI, "--panel", "st7789", "--orbit", "--view",
                 "walk-1"),
                ("leave --lamp out", "sim", FUJI, "--panel", "st7789", "--spin-sun", "--lamp", 1, 2,
                 3),
                ("--band", "sim", FUJI, "--panel", "ssd1306", "--band", 9),
                ("name a code", "show", "--panel", "st7789", *wires),
                ("name the panel", "show", FUJI, *wires),
                ("how the panel is wired", "show", FUJI, "--panel", "st7789"),
                ("there is no bus 'i2c'", "show", FUJI, "--panel", "st7789", "--bus", "i2c"),
                ("needs the device", "show", FUJI, "--panel", "st7789", "--bus", "spidev"),
                ("needs the line --dc", "show", FUJI, "--panel", "st7789", *wires[:-2]),
                ("has no D/C line", "show", FUJI, "--panel", "ls013b7dh03", *wires),
                ("for --bus spidev", "show", FUJI, "--panel", "st7789", *wires, "--spi", "x"),
                ("LINE=ACT", "show", FUJI, "--panel", "st7789", *wires, "--button", "5=jump"),
                ("LINE=ACT", "show", FUJI, "--panel", "st7789", *wires, "--button", "=next"),
                ("--once", "show", FUJI, "--panel", "st7789", *wires, "--once", "--retry")):
            with self.subTest(words=words):
                self.refused(2, sentence, *words)

    def test_no_wires(self):
        self.refused(3, "gpiochip987", "show", FUJI, "--panel", "st7789", "--bus", "gpiod",
                     "--gpiochip", "gpiochip987", "--sck", 1, "--mosi", 2, "--cs", 3, "--dc", 4)
        self.refused(1, "nowhere", "show", "nowhere", "--panel", "st7789", "--bus", "gpiod",
                     "--sck", 1, "--mosi", 2, "--cs", 3, "--dc", 4)

    def test_files_stay(self):
        path = self.folder / "there.png"
        path.write_bytes(b"mine")
        self.refused(1, "there.png", "sim", FUJI, "--panel", "st7789", "--frames", 1, "--png", path)
        self.assertEqual(path.read_bytes(), b"mine")


if __name__ == "__main__":
    unittest.main()
