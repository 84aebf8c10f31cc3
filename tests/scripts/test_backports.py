#!/usr/bin/env python3
"""scripts/backports on machines that do not exist: their apt sources, a false apt-get and dpkg-deb."""

import os
import pathlib
import shutil
import subprocess
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
# What it may use of the real machine; nothing else is on its PATH.
REAL = ("bash", "env", "dirname", "awk", "sed", "cat", "rm", "mkdir", "mv", "cp")

MIRROR_LIST = """\
# deb http://commented.example/debian bookworm main
deb [signed-by=/keys/a.gpg arch=amd64] http://list.example/debian bookworm main contrib
deb-src http://list.example/debian bookworm main
deb http://list.example/debian bookworm-updates main
deb http://security.example/debian-security bookworm-security main
"""
MIRROR_SOURCES = """\
Types: deb deb-src
# a remark
URIs: http://sources.example/debian
Suites: bookworm bookworm-updates
Components: main
Signed-By: /keys/b.gpg

Types: deb
URIs: http://security.example/debian-security
Suites: bookworm-security
Components: main

Types: deb
Enabled: no
URIs: http://disabled.example/debian
Suites: bookworm
Components: main
"""


class Backports(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        self.top = pathlib.Path(self.folder.name)
        self.bin = self.top / "bin"
        self.apt = self.top / "apt"
        self.out = self.top / "build/backports"
        for folder in (self.top / "scripts", self.bin, self.apt / "sources.list.d"):
            folder.mkdir(parents=True)
        shutil.copy(ROOT / "scripts/backports", self.top / "scripts/backports")
        for name in REAL:
            (self.bin / name).symlink_to(shutil.which(name))
        self.command("apt-get", """
            echo "$*" >>"$CALLS"
            case "$*" in
            *" update") echo chatter ;;
            *" download "*) echo deb >libgpiod-dev.deb; echo deb >libgpiod3.deb ;;
            esac""")
        # dpkg-deb -x DEB FOLDER
        self.command("dpkg-deb", """
            mkdir -p "$3/usr/lib/x/pkgconfig"
            printf 'prefix=/usr\\nlibdir=/usr/lib/x\\nName: libgpiod\\n' >"$3/usr/lib/x/pkgconfig/libgpiod.pc"
            """)

    def command(self, name, body):
        path = self.bin / name
        path.write_text(f"#!{shutil.which('bash')}\n{body}\n")
        path.chmod(0o755)

    def run_it(self):
        calls = self.top / "calls"
        calls.unlink(missing_ok=True)
        result = subprocess.run(
            [str(self.top / "scripts/backports")], capture_output=True, text=True,
            stdin=subprocess.DEVNULL, check=False, cwd="/",
            env={"PATH": str(self.bin), "CALLS": str(calls), "YB_ETC_APT": str(self.apt)})
        self.calls = calls.read_text().splitlines() if calls.exists() else []
        self.assertEqual(result.stdout, "")
        return result

    def sources(self, ending):
        return (self.out / f"sources/backports.{ending}").read_text()

    def test_one_line_sources(self):
        (self.apt / "sources.list").write_text(MIRROR_LIST)
        result = self.run_it()
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        self.assertEqual(self.sources("list"), "deb [signed-by=/keys/a.gpg arch=amd64] "
                         "http://list.example/debian bookworm-backports main contrib\n")
        self.assertEqual(self.sources("sources").strip(), "")

    def test_sources_in_paragraphs(self):
        (self.apt / "sources.list.d/debian.sources").write_text(MIRROR_SOURCES)
        result = self.run_it()
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        self.assertEqual(self.sources("sources").strip().splitlines(), [
            "Types: deb", "URIs: http://sources.example/debian", "Suites: bookworm-backports",
            "Components: main", "Signed-By: /keys/b.gpg"])

    def test_nothing_outside_its_folder(self):
        (self.apt / "sources.list").write_text(MIRROR_LIST)
        self.run_it()
        self.assertEqual(len(self.calls), 2)
        for call in self.calls:
            self.assertIn(f"-c {self.out}/apt.conf", call)
        conf = (self.out / "apt.conf").read_text()
        self.assertIn(f'Dir::Etc::SourceParts "{self.out}/sources"', conf)
        self.assertIn(f'Dir::State::Lists "{self.out}/lists"', conf)
        self.assertIn(f'Dir::Cache "{self.out}/cache"', conf)
        self.assertIn("#clear APT::Update::Post-Invoke;", conf)

    def test_unpacked_once_and_found_by_pkg_config(self):
        (self.apt / "sources.list").write_text(MIRROR_LIST)
        self.run_it()
        module = (self.out / "root/usr/lib/x/pkgconfig/libgpiod.pc").read_text()
        self.assertEqual(module, "prefix=${pcfiledir}/../../..\nlibdir=${prefix}/lib/x\n"
                         "Name: libgpiod\n")
        result = self.run_it()
        self.assertEqual((result.returncode, result.stderr, self.calls), (0, "", []))

    def test_no_source_of_the_release(self):
        (self.apt / "sources.list").write_text("deb http://other.example/debian trixie main\n")
        result = self.run_it()
        self.assertEqual((result.returncode, self.calls), (77, []))
        self.assertIn("no source of bookworm", result.stderr)

    def test_no_network(self):
        (self.apt / "sources.list").write_text(MIRROR_LIST)
        self.command("apt-get", 'echo "$*" >>"$CALLS"; exit 100')
        result = self.run_it()
        self.assertEqual((result.returncode, len(self.calls)), (77, 1))
        self.assertIn("cannot be reached", result.stderr)
        self.assertFalse((self.out / "root").exists())
        # The next time it is tried again.
        self.assertEqual(self.run_it().returncode, 77)
        self.assertEqual(len(self.calls), 1)

    def test_no_debian(self):
        os.unlink(self.bin / "dpkg-deb")
        result = self.run_it()
        self.assertEqual((result.returncode, self.calls), (77, []))
        self.assertIn("no dpkg-deb", result.stderr)


if __name__ == "__main__":
    unittest.main()
