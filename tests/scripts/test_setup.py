#!/usr/bin/env python3
"""scripts/setup on machines that do not exist: false dpkg-query, apt-get, sudo, id and uname."""

import os
import pathlib
import shutil
import subprocess
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
# What setup may use of the real machine; nothing else is on its PATH.
REAL = ("bash", "env", "dirname", "awk", "grep", "mkdir", "tail", "cat")
MISSING = ("cmake", "flex", "python-matplotlib-data")


class Setup(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        self.top = pathlib.Path(self.folder.name)
        self.bin = self.top / "bin"
        (self.top / "scripts").mkdir()
        self.bin.mkdir()
        shutil.copy(ROOT / "scripts/setup", self.top / "scripts/setup")
        self.backports()
        for name in REAL:
            (self.bin / name).symlink_to(shutil.which(name))
        self.debian()
        self.user("root")
        self.machine("x86_64")
        self.installed(all_but=())
        self.command("apt-get", 'echo "apt-get $*" >>"$CALLS"; echo chatter; echo worse >&2')
        self.command("sudo", "exit 1")

    def command(self, name, body):
        path = self.bin / name
        path.unlink(missing_ok=True)
        path.write_text(f"#!{shutil.which('bash')}\n{body}\n")
        path.chmod(0o755)

    def backports(self, body=""):
        path = self.top / "scripts/backports"
        path.write_text(f"#!{shutil.which('bash')}\necho asked >>\"$BACKPORTS\"\n{body}\n")
        path.chmod(0o755)

    def debian(self, text="ID=debian\nVERSION_ID=\"12\"\n"):
        (self.top / "os-release").write_text(text)

    def user(self, name):
        self.command("id", f"echo {0 if name == 'root' else 1000}")

    def machine(self, name):
        self.command("uname", f"echo {name}")

    def installed(self, all_but):
        """As dpkg-query does: unknown packages are complained about and end in 1."""
        self.command("dpkg-query", f"""
            shift 3; status=0
            for package; do
                case " {' '.join(all_but)} " in
                *" $package "*) echo "no packages found matching $package" >&2; status=1 ;;
                *) echo "$package installed" ;;
                esac
            done
            exit $status""")

    def run_setup(self, *arguments):
        calls = self.top / "calls"
        calls.unlink(missing_ok=True)
        backports = self.top / "backports"
        backports.unlink(missing_ok=True)
        result = subprocess.run(
            [str(self.top / "scripts/setup"), *arguments], capture_output=True, text=True,
            stdin=subprocess.DEVNULL, check=False, cwd="/",
            env={"PATH": str(self.bin), "CALLS": str(calls), "BACKPORTS": str(backports),
                 "YB_OS_RELEASE": str(self.top / "os-release")})
        self.calls = calls.read_text().splitlines() if calls.exists() else []
        self.backports_asked = backports.exists()
        self.assertEqual(result.stdout, "")
        return result

    def test_nothing_missing(self):
        result = self.run_setup()
        self.assertEqual((result.returncode, result.stderr, self.calls), (0, "", []))
        self.assertFalse((self.top / "build").exists())

    def test_installs_what_is_missing_and_no_more(self):
        self.installed(all_but=MISSING)
        result = self.run_setup()
        self.assertEqual(result.returncode, 0)
        self.assertEqual(len(self.calls), 2)
        self.assertTrue(self.calls[0].endswith(" update"), self.calls)
        self.assertIn("--no-install-recommends", self.calls[1])
        self.assertEqual(sorted(self.calls[1].split()[-3:]), sorted(MISSING))
        self.assertNotIn("chatter", result.stderr)
        log = (self.top / "build/setup.log").read_text()
        self.assertIn("chatter", log)
        self.assertIn("worse", log)

    def test_removed_but_configured_is_missing(self):
        self.command("dpkg-query", "shift 3; for p; do "
                     "[ $p = gcc ] && echo gcc config-files || echo $p installed; done")
        self.run_setup()
        self.assertEqual(self.calls[1].split()[-1], "gcc")

    def test_demo_needs_less(self):
        self.installed(all_but=("cmake", "flex", "clang", "shellcheck"))
        self.assertEqual(self.run_setup("--demo").returncode, 0)
        self.assertTrue(self.calls[1].endswith("recommends cmake"), self.calls)

    def test_backports_are_for_the_guest_tests(self):
        for argument, machine, asked in (("--all", "x86_64", True), ("--demo", "x86_64", False),
                                         ("--bench", "x86_64", False), ("--all", "aarch64", False)):
            self.machine(machine)
            self.assertEqual(self.run_setup(argument).returncode, 0)
            self.assertEqual(self.backports_asked, asked, (argument, machine))

    def test_missing_backports_are_no_failure(self):
        self.backports("echo 'no backports here' >&2; exit 77")
        result = self.run_setup()
        self.assertEqual((result.returncode, self.calls), (0, []))
        self.assertEqual(result.stderr, "no backports here\n")

    def test_stale_lists_may_do(self):
        self.installed(all_but=("flex",))
        self.command("apt-get", 'echo "$*" >>"$CALLS"; [ "${*: -1}" != update ]')
        self.assertEqual(self.run_setup().returncode, 0)

    def test_failing_installation(self):
        self.installed(all_but=("flex",))
        self.command("apt-get", 'echo "E: held back"; [ "${*: -1}" = update ]')
        result = self.run_setup()
        self.assertEqual(result.returncode, 1)
        self.assertIn("E: held back", result.stderr)
        self.assertIn("could not install flex", result.stderr.splitlines()[-1])
        self.assertIn("build/setup.log", result.stderr.splitlines()[-1])

    def test_sudo(self):
        self.user("somebody")
        self.installed(all_but=("flex",))
        self.command("sudo", 'echo "sudo $*" >>"$CALLS"; [ "$1" = -n ] && shift; "$@"')
        self.command("true", "")
        self.assertEqual(self.run_setup().returncode, 0)
        self.assertTrue(any(call.startswith("sudo -n env DEBIAN_FRONTEND=noninteractive apt-get")
                            for call in self.calls), self.calls)
        self.assertTrue(self.calls[-1].endswith(" flex"))

    def test_neither_root_nor_sudo(self):
        self.user("somebody")
        self.installed(all_but=MISSING)
        result = self.run_setup()
        self.assertEqual((result.returncode, self.calls), (1, []))
        line = result.stderr.splitlines()[-1]
        self.assertTrue(line.startswith("apt-get update && apt-get install"), line)
        for package in MISSING:
            self.assertIn(f" {package}", line)

    def test_arm64_leaves_the_guest_out(self):
        self.machine("aarch64")
        self.installed(all_but=("linux-source-6.1", "flex"))
        result = self.run_setup()
        self.assertEqual((result.returncode, self.calls), (0, []))
        self.assertIn("guest tests are not run", result.stderr)

    def test_another_system_with_the_tools(self):
        self.debian("ID=fedora\nVERSION_ID=40\n")
        (self.bin / "dpkg-query").unlink()
        for name in ("gcc make cmake ninja pkg-config arm-none-eabi-gcc qemu-system-arm "
                     "riscv64-unknown-elf-gcc avr-gcc qemu-system-avr powerpc-linux-gnu-gcc qemu-ppc "
                     "python3 clang llvm-symbolizer g++ clang-format clang-tidy cppcheck "
                     "shellcheck man groff flex bison bc perl xz dtc "
                     "qemu-system-x86_64").split():
            self.command(name, "")
        result = self.run_setup()
        self.assertEqual((result.returncode, self.calls), (0, []))
        self.assertEqual(len(result.stderr.splitlines()), 1)
        self.assertIn("fedora 40", result.stderr)

        (self.bin / "ninja").unlink()
        self.command("pkg-config", '[ "$2" != gdal ]')
        result = self.run_setup()
        self.assertEqual(result.returncode, 1)
        self.assertIn("missing: ninja (ninja-build), libgdal-dev", result.stderr)
        self.assertNotIn("libpng", result.stderr)

    def test_unknown_argument(self):
        self.assertEqual(self.run_setup("--what").returncode, 2)


if __name__ == "__main__":
    unittest.main()
