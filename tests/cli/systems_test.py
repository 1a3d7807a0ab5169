"""Systems by the ifsm program, from outside: python3 systems_test.py PROGRAM"""
import json
import signal
import struct
import subprocess
import time
import unittest
import zlib

from program_test import PROGRAM, Program, default_signals, numbers

TWO = """gasket { .5 0 0 .5 0 0 1
 .5 0 0 .5 .5 0 1
 .5 0 0 .5 0 .5 1 }
line { .5 0 0 .5 0 0 1 .5 0 0 .5 1 0 1 }
"""
FLAME = '<flame name="half"><xform weight="1" linear="1" coefs=".5 0 0 .5 1 0"/></flame>'
BENT = '<flame name="bent"><xform weight="1" spherical="1" coefs=".5 0 0 .5 1 0"/></flame>'


def pixels_of(png):
    """Rows of (red, green, blue, alpha), of an eight-bit RGBA PNG."""
    assert png[:8] == b"\x89PNG\r\n\x1a\n"
    at, data, size = 8, b"", None
    while at < len(png):
        length, kind = struct.unpack(">I4s", png[at:at + 8])
        body = png[at + 8:at + 8 + length]
        if kind == b"IHDR":
            size = struct.unpack(">II", body[:8])
            assert body[8:10] == b"\x08\x06", "not RGBA"
        data += body if kind == b"IDAT" else b""
        at += length + 12
    raw, (width, height), before, rows = zlib.decompress(data), size, None, []
    for y in range(height):
        how, line = raw[y * (4 * width + 1)], bytearray(raw[y * (4 * width + 1) + 1:(y + 1) * (4 * width + 1)])
        before = before or bytearray(4 * width)
        for k in range(4 * width):
            a, b, c = line[k - 4] if k > 3 else 0, before[k], before[k - 4] if k > 3 else 0
            p = a + b - c
            paeth = min((abs(p - a), 0, a), (abs(p - b), 1, b), (abs(p - c), 2, c))[2]
            line[k] = (line[k] + [0, a, b, (a + b) // 2, paeth][how]) & 255
        before = line
        rows.append([tuple(line[4 * x:4 * x + 4]) for x in range(width)])
    return rows


class Systems(Program):
    def picture(self, *arguments):
        path = self.file("picture.png")
        report = json.loads(self.fine("render", *arguments, "--json", "-o", path))
        return pixels_of(path.read_bytes()), report

    def test_render_draws_the_gasket_where_it_is(self):
        rows, report = self.picture("gasket-right", "--size", 64, "--window", "0,0,1,1", "--colour", "set",
                                    "--oversample", 1)
        self.assertEqual((len(rows), len(rows[0]), report["width"], report["height"]), (64, 64, 64, 64))
        # Sierpinski's rule: pixel (x, y) from the lower left is met when x and y share no bit.
        for y, row in enumerate(reversed(rows)):
            for x, pixel in enumerate(row):
                if x & y == 0:
                    self.assertEqual(pixel[3], 255, (x, y))
        self.assertEqual(rows[0][-1][3], 0)
        self.assertGreaterEqual(report["met"], 3 ** 6)

    def test_render_has_the_background_that_is_asked_for(self):
        rows, _ = self.picture("fern", "--size", 40, "--points", 1000)
        self.assertEqual(rows[0][0], (0, 0, 0, 0))
        for background, corner in (("white", (255, 255, 255, 255)), ("#123", (17, 34, 51, 255)),
                                   ("#11223380", (17, 34, 51, 128))):
            rows, _ = self.picture("fern", "--size", 40, "--points", 1000, "--background", background)
            self.assertEqual(rows[0][0], corner)

    def test_render_says_that_a_window_misses(self):
        words = self.fine("render", "fern", "--window", "50,50,60,60", "--size", 16, "-o", self.file("x.png"))
        self.assertIn("the window misses the attractor", words)

    def test_the_same_seed_draws_the_same_picture(self):
        files = [self.file(f"{k}.png") for k in range(3)]
        for path, seed in zip(files, (1, 1, 2)):
            self.fine("render", "sponge", "--size", 50, "--points", 100000, "--seed", seed, "-o", path)
        first, again, other = [path.read_bytes() for path in files]
        self.assertEqual(first, again)
        self.assertNotEqual(first, other)

    def test_points_go_into_tables_and_ply(self):
        points = numbers(self.fine("render", "gasket-right", "--points", 1000, "--format", "csv", "-o", "-"))
        self.assertEqual(len(points), 1000)
        self.assertTrue(all(x >= 0 and y >= 0 and x + y <= 1 + 1e-12 for x, y in points))
        path = self.file("sponge.ply")
        self.fine("render", "sponge", "--points", 1000, "-o", path)
        head, body = path.read_bytes().split(b"end_header\n", 1)
        self.assertIn(b"element vertex 1000\n", head)
        self.assertEqual(len(body), 13 * 1000)
        self.assertTrue(all(0 <= v <= 1.001 for k in range(1000) for v in struct.unpack("<fff", body[13 * k:13 * k + 12])))

    def test_info_tells_what_is_known(self):
        told = json.loads(self.fine("info", "carpet", "--json"))
        self.assertAlmostEqual(told["similarity_dimension"], 1.8927892607, places=9)
        self.assertAlmostEqual(told["diameter"], 2 ** .5, places=8)
        self.assertEqual(told["contractive"], "proven")
        words = self.fine("info", "fern")
        for word in ("4 maps of the plane", "(-2.182, 0) to (2.656, 9.998)", "0.85"):
            self.assertIn(word, words)

    def test_info_names_the_word_that_does_not_contract(self):
        path = self.file("grows.ifs", "grows { 0 4 0 0 0 0 1  0 0 .5 0 0 0 1 }\n")
        self.assertIn("refuted: the word [", self.fine("info", path))
        self.refused(3, "spectral radius", "render", path, "-o", self.file("x.png"))

    def test_formats_are_converted_and_back(self):
        start = self.file("fern.json")
        self.fine("convert", "fern", "-o", start)
        for way in (("fern.cbor",), ("fern.ifs",), ("fern.cbor", "fern.ifs", "other.cbor")):
            last = start
            for name in way:
                self.fine("convert", last, "-o", self.file(name))
                last = self.file(name)
            self.fine("convert", last, "-o", self.file("back.json"))
            a, b = json.loads(start.read_text()), json.loads(self.file("back.json").read_text())
            self.assertEqual([(m["matrix"], m["shift"]) for m in a["maps"]], [(m["matrix"], m["shift"]) for m in b["maps"]])

    def test_a_system_becomes_a_model_and_back(self):
        self.fine("convert", "koch", "-o", self.file("koch.ifsm"))
        told = json.loads(self.fine("info", self.file("koch.ifsm"), "--json"))
        self.assertEqual((told["topology"], told["control_points"], told["maps"]), ("joined", 3, 4))
        self.fine("convert", self.file("koch.ifsm"), "-o", self.file("back.json"))
        back = json.loads(self.file("back.json").read_text())
        self.assertAlmostEqual(back["maps"][0]["matrix"][0], 1 / 3)
        self.fine("convert", "fern", "-o", self.file("fern.ifsm"))  # no chain
        self.assertEqual(json.loads(self.fine("info", self.file("fern.ifsm"), "--json"))["topology"], "square")

    def test_files_of_several_are_asked_by_name(self):
        path = self.file("two.ifs", TWO)
        self.assertEqual(json.loads(self.fine("info", path, "--json"))["systems"], ["gasket", "line"])
        self.assertIn("2 maps of the plane", self.fine("info", path, "--name", "line"))
        self.refused(3, "--name one of \"gasket\", \"line\"", "render", path, "-o", self.file("x.png"))
        self.refused(2, "holds no system \"dragon\"", "info", path, "--name", "dragon")
        self.fine("info", self.file("half.flame", FLAME))
        both = self.file("both.flame", "<flames>" + FLAME + BENT + "</flames>")
        self.assertEqual(json.loads(self.fine("info", both, "--json"))["systems"], ["half", "bent"])
        self.fine("info", both, "--name", "half")
        self.refused(3, "spherical", "info", self.file("bent.flame", BENT))

    def test_what_cannot_be_is_refused(self):
        out = self.file("x.png")
        self.refused(2, "There is no system \"frn\". Did you mean fern?", "render", "frn", "-o", out)
        self.refused(2, "--window has 2 numbers", "render", "fern", "--window", "1,2", "-o", out)
        self.refused(2, "with left < right", "render", "fern", "--window", "1,0,0,1", "-o", out)
        self.refused(2, "'mauve' is no colour", "render", "fern", "--background", "mauve", "-o", out)
        self.refused(2, "ends in none of", "render", "fern", "-o", self.file("x.gif"))
        self.refused(2, "--colour set: The system lies in space", "render", "sponge", "--colour", "set", "-o", out)
        self.refused(3, "cannot be opened", "render", "./missing.ifs", "-o", out)
        self.refused(2, "--name goes with a file", "info", "fern", "--name", "x")
        self.assertFalse(out.exists())

    def test_options_that_do_not_count_are_refused(self):
        png, csv = self.file("x.png"), self.file("x.csv")
        self.refused(2, "--window is of pictures", "render", "fern", "--window", "0,0,1,1", "-o", csv)
        self.refused(2, "--symbols goes with --colour address", "render", "fern", "--symbols", 2, "-o", png)
        self.refused(2, "--tolerance goes with", "render", "fern", "--tolerance", .5, "-o", png)
        self.refused(2, "--points does not go", "render", "fern", "--points", 5, "--colour", "set", "-o", png)
        self.refused(2, "with left < right", "render", "fern", "--window", "0,0,0,0", "-o", png)
        self.refused(2, "--azimuth goes with systems of space", "render", "fern", "--azimuth", 5, "-o", png)
        self.refused(2, "--levels goes with a model", "convert", "fern", "--levels", 5, "-o", self.file("x.json"))
        self.refused(2, "has 20 active maps", "convert", "sponge", "-o", self.file("x.ifsm"))

    def test_a_set_tells_its_pixels_or_that_the_window_misses(self):
        out = self.file("x.png")
        words = self.fine("render", "fern", "--colour", "set", "--size", 8, "-o", out)
        self.assertRegex(words, r"of the computed ones \d+ met, \d+ undecided")
        for colour in ("set", "distance"):
            words = self.fine("render", "fern", "--colour", colour, "--window", "50,50,60,60", "--size", 8, "-o", out)
            self.assertIn("the window misses the attractor", words)
            self.refused(2, "--seed does not go with --colour " + colour, "render", "fern", "--colour", colour, "--seed", 5,
                         "-o", out)
        self.refused(2, "--azimuth", "render", "sponge", "--azimuth", "inf", "-o", out)

    def test_a_small_window_on_the_stem_is_not_said_to_miss(self):
        words = self.fine("render", "fern", "--window=-0.000005,0.5,0.000005,0.50001", "--size", 8, "--points", 1000, "-o",
                          self.file("x.png"))
        self.assertNotIn("misses", words)
        self.assertIn("y from 0.5 to 0.50001", words)

    def test_a_signal_ends_a_long_drawing_and_leaves_nothing(self):
        out = self.file("x.png")
        job = subprocess.Popen([PROGRAM, "render", "fern", "--points", str(10 ** 14), "-o", out], stderr=subprocess.PIPE,
                               preexec_fn=default_signals)
        time.sleep(1)
        job.send_signal(signal.SIGINT)
        job.communicate(timeout=30)
        self.assertEqual(job.returncode, 130)
        self.assertFalse(out.exists())

    def test_a_signal_ends_the_writing_of_a_png_and_leaves_nothing(self):
        out = self.file("x.png")
        job = subprocess.Popen([PROGRAM, "render", "fern", "--size", "8000", "--colour", "set", "-o", out],
                               stderr=subprocess.PIPE, text=True, preexec_fn=default_signals)
        for line in job.stderr:
            if "75 %" in line:  # the pixels are there, the file's bytes are not
                break
        job.send_signal(signal.SIGINT)
        signalled = time.monotonic()
        job.communicate(timeout=30)
        self.assertEqual(job.returncode, 130)
        self.assertLess(time.monotonic() - signalled, 20)
        self.assertFalse(out.exists())

    def test_systems_are_listed(self):
        names = [entry["name"] for entry in json.loads(self.fine("systems", "--json"))]
        self.assertIn("fern_barnsley", names)
        words = self.fine("systems")
        self.assertTrue(all(name in words for name in names))


if __name__ == "__main__":
    unittest.main()
