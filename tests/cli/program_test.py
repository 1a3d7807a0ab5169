"""The ifsm program and the demo beside it, from outside: python3 program_test.py PROGRAM"""
import json
import math
import os
import pathlib
import resource
import signal
import subprocess
import sys
import tempfile
import time
import unittest
import xml.etree.ElementTree as ElementTree

PROGRAM = os.path.abspath(sys.argv.pop(1)) if len(sys.argv) > 1 else "ifsm"

DEMO = os.path.join(os.path.dirname(PROGRAM), "ifsm-demo")


def default_signals():
    # A runner in the background may have been started with SIGINT ignored.
    signal.signal(signal.SIGINT, signal.SIG_DFL)


def run(*arguments, stdin=None, **options):
    return subprocess.run([PROGRAM, *map(str, arguments)], input=stdin, capture_output=True, text=True, **options)


def rough_ring(count):
    """A closed curve with detail on every scale, the same every time."""
    points = []
    for k in range(count):
        angle = 2 * math.pi * k / count
        radius = 100 + sum(20 / f ** 1.2 * math.sin(f * angle + f * f) for f in range(2, 60))
        points.append((radius * math.cos(angle), radius * math.sin(angle)))
    return points


def table(points, header="x,y"):
    lines = [header] if header else []
    return "\n".join(lines + [",".join(repr(value) for value in point) for point in points]) + "\n"


def numbers(text):
    return [tuple(map(float, line.split(","))) for line in text.splitlines() if line[0] in "-0123456789"]


def largest_gap(a, b):
    assert len(a) == len(b), (len(a), len(b))
    return max(math.dist(p, q) for p, q in zip(a, b))


class Program(unittest.TestCase):
    def setUp(self):
        self.scratch = tempfile.TemporaryDirectory()
        self.addCleanup(self.scratch.cleanup)
        self.folder = pathlib.Path(self.scratch.name)

    def file(self, name, text=None):
        path = self.folder / name
        if text is not None:
            path.write_text(text)
        return path

    def names(self):
        return sorted(path.name for path in self.folder.iterdir())

    def fine(self, *arguments, **options):
        result = run(*arguments, **options)
        self.assertEqual(result.returncode, 0, result.stderr)
        return result.stdout

    def refused(self, code, words, *arguments, **options):
        """Fails with that code, says those words, prints nothing on standard output."""
        result = run(*arguments, **options)
        self.assertEqual(result.returncode, code, result.stderr)
        for word in [words] if isinstance(words, str) else words:
            self.assertIn(word, result.stderr)
        self.assertEqual(result.stdout, "")

    def model(self, name="ring.ifsm", count=300):
        path = self.file(name)
        if not path.exists():
            source = self.file("ring.csv", table(rough_ring(count)))
            self.fine("fit", source, "--closed", "--no-fit", "-q", "-o", path)
        return path


class RoundTrips(Program):
    def test_a_fit_gives_its_samples_back(self):
        points = rough_ring(400)
        source, model, back = self.file("in.csv", table(points)), self.file("m.ifsm"), self.file("out.csv")
        report = json.loads(self.fine("fit", source, "--closed", "--budget", "8,32", "--iterations", 10, "--rounds", 1,
                                      "--json", "-q", "-o", model))
        self.assertEqual([row["budget"] for row in report["fit"]["budgets"]], [8, 32])
        for row in report["fit"]["budgets"]:
            self.assertLessEqual(row["rms"], row["start_rms"])
        self.assertEqual(report["bytes"], model.stat().st_size)
        self.fine("synth", model, "-o", back)
        self.assertLess(largest_gap(points, numbers(back.read_text())), 1e-9)

    def test_sketches_are_as_far_from_the_samples_as_the_report_says(self):
        model = self.model()
        points, sketch = rough_ring(300), self.file("sketch.csv")
        report = json.loads(self.fine("synth", model, "--details", 20, "--resolve", "--json", "-o", sketch))
        read = numbers(sketch.read_text())
        rms = math.sqrt(sum(math.dist(p, q) ** 2 for p, q in zip(points, read)) / len(points))
        self.assertAlmostEqual(report["rms"], rms, delta=1e-9 * rms)
        self.assertAlmostEqual(report["max"], largest_gap(points, read), delta=1e-9 * rms)
        self.assertEqual(report["details_kept"], 20)

    def test_both_formats_hold_the_same_model(self):
        source = self.file("in.csv", table(rough_ring(100)))
        for name in ("m.json", "m.ifsm"):
            self.fine("fit", source, "--closed", "--no-fit", "-o", self.file(name))
        json.loads(self.file("m.json").read_text())
        self.assertEqual(self.fine("synth", self.file("m.json")), self.fine("synth", self.file("m.ifsm")))

    def test_pipes_do_what_files_do(self):
        text = table(rough_ring(64))
        model = self.fine("fit", "-", "--closed", "--no-fit", "--format", "json", "-o", "-", stdin=text)
        self.assertLess(largest_gap(numbers(text), numbers(self.fine("synth", "-", stdin=model))), 1e-9)

    def test_evaluation_at_samples_and_elsewhere(self):
        model = self.model()
        rows = numbers(self.fine("eval", model, "--at", "0,0.25,1.25"))
        self.assertEqual([row[0] for row in rows], [0, 0.25, 1.25])
        self.assertEqual(rows[1][1:], rows[2][1:])  # closed: the fraction counts
        self.assertLess(math.dist(rows[0][1:], rough_ring(300)[0]), 1e-9)
        self.assertEqual(numbers(self.fine("eval", model, "--at", "-", stdin="0\n0.25\n1.25\n")), rows)
        self.assertEqual(numbers(self.fine("eval", model, "--params", self.file("t.csv", "t\n0\n0.25\n1.25\n"))), rows)
        told = json.loads(self.fine("eval", model, "--at", "0.25", "--json"))
        self.assertEqual(tuple(told["points"][0]["point"]), rows[1][1:])
        limit = numbers(self.fine("eval", model, "--at", "0.25", "--limit"))
        self.assertLess(math.dist(limit[0][1:], rows[1][1:]), 10)

    def test_points_of_levels_and_in_equal_steps(self):
        model = self.model()
        info = json.loads(self.fine("info", model, "--json"))
        self.assertEqual(len(numbers(self.fine("synth", model, "--level", 0))), info["control_points"])
        self.assertEqual(len(numbers(self.fine("synth", model, "--samples", 17))), 17)
        self.assertEqual(numbers(self.fine("synth", model, "--samples", 4)),
                         [row[1:] for row in numbers(self.fine("eval", model, "--at", "0,0.25,0.5,0.75"))])
        self.assertTrue(self.fine("synth", model, "--separator", "tab").startswith("x\ty\n"))
        self.assertFalse(self.fine("synth", model, "--no-header").startswith("x"))

    def test_an_open_curve_of_any_dimension(self):
        for dimension in (1, 2, 3, 4):
            points = [tuple(math.sin((d + 1) * k / 9) for d in range(dimension)) for k in range(60)]
            source = self.file("in.csv", table(points, header=None))
            self.fine("fit", source, "--no-fit", "-q", "-o", self.file("m.ifsm"))
            back = numbers(self.fine("synth", self.file("m.ifsm")))
            self.assertLess(largest_gap(points, back), 1e-12)


class Options(Program):
    def test_lists_do_not_swallow_what_follows_them(self):
        source = self.file("in.csv", table([(k, k * k % 7, 5) for k in range(40)], "x,y,z"))
        for arguments in (("--columns", "x,y", source), (source, "--columns", "2,1"), ("--columns=y,x", source)):
            report = json.loads(self.fine("fit", "--no-fit", *arguments, "--json", "-o", self.file("m.ifsm")))
            self.assertEqual(report["dimension"], 2)
        report = json.loads(self.fine("fit", "--budget", "8,16", source, "--json", "-q", "-o", self.file("m.ifsm")))
        self.assertEqual(len(report["fit"]["budgets"]), 2)

    def test_every_way_to_resolve_comes_nearer(self):
        model, out = self.model(), self.file("out.csv")
        rms = [json.loads(self.fine("synth", model, "--details", 30, *resolve, "--json", "-o", out))["rms"]
               for resolve in ([], ["--resolve=values"], ["--resolve"])]
        self.assertEqual(rms, sorted(rms, reverse=True))
        self.refused(2, "--resolve", "synth", model, "--details", "30", "--resolve=guess")


class Tolerances(Program):
    def test_a_sketch_keeps_its_bound_with_few_details(self):
        model, out = self.model(), self.file("out.csv")
        every = {}
        for distance, key in (("rms", "rms"), ("max", "max"), ("hausdorff", "hausdorff")):
            for resolve in ((), ("--resolve=values",), ("--resolve=none",)):
                told = json.loads(self.fine("synth", model, "--within", 4, "--distance", distance, *resolve, "--json",
                                            "-q", "-o", out))
                self.assertLessEqual(told[key], 4)
                self.assertGreater(told["details_kept"], 0)
                every[distance, resolve] = told["details_kept"]
            self.assertLessEqual(every[distance, ()], every[distance, ("--resolve=none",)])
        self.assertLessEqual(every["rms", ()], every["max", ()])

    def test_a_fit_to_a_tolerance_writes_the_sketch_that_it_tells(self):
        source = self.file("ring.csv", table(rough_ring(300)))
        exact, small, plain = self.file("exact.ifsm"), self.file("small.ifsm"), self.file("plain.ifsm")
        bound = ("--closed", "--within", 4, "--distance", "hausdorff", "--json", "-q")
        whole = json.loads(self.fine("fit", source, *bound, "-o", exact))
        sketch = json.loads(self.fine("fit", source, *bound, "--sketch", "-o", small))
        self.assertEqual(whole["fit"], sketch["fit"])
        row = sketch["fit"]["budgets"][0]
        self.assertEqual(sketch["details_kept"], row["details"])
        self.assertLessEqual(row["details"], row["start_details"])
        self.assertLess(sketch["bytes"], whole["bytes"])
        unfitted = json.loads(self.fine("fit", source, *bound, "--no-fit", "--sketch", "-o", plain))
        self.assertEqual(unfitted["details_kept"], row["start_details"])

    def test_misuse(self):
        source, model, out = self.file("ring.csv", table(rough_ring(300))), self.model(), self.file("out.ifsm")
        for words, arguments in (
            ("not a number above 0", ("--within", 0)),
            ("not a number above 0", ("--within", "nan")),
            ("is none of", ("--within", 1, "--distance", "far")),
            ("add --within", ("--distance", "max")),
            ("--budget", ("--within", 1, "--budget", 32)),
            ("give only one", ("--within", 1, "--maps", "auto")),
            ("--stage sparse", ("--within", 1, "--stage", "curve")),
            ("--stage sparse", ("--sketch", "--stage", "filter")),
            ("go together", ("--no-fit", "--within", 1)),
            ("go together", ("--no-fit", "--sketch")),
        ):
            self.refused(2, words, "fit", source, *arguments, "-o", out)
        self.refused(2, "give at least", "fit", source, "--within", 1e-30, "-o", out)
        for words, arguments in (
            ("--details", ("--within", 1, "--details", 5)),
            ("--threshold", ("--within", 1, "--threshold", 5)),
            ("--distance is for", ("--details", 5, "--distance", "max")),
            ("give at least", ("--within", 1e-30)),
        ):
            self.refused(2, words, "synth", model, *arguments, "-o", out)
        self.assertFalse(out.exists())


class Reports(Program):
    def test_info_adds_up(self):
        info = json.loads(self.fine("info", self.model(), "--json"))
        self.assertEqual((info["samples"], info["dimension"], info["closed"]), (300, 2, True))
        self.assertEqual(sum(level["details"] for level in info["energy_by_level"]), info["details"])
        self.assertEqual(sum(level["kept"] for level in info["energy_by_level"]), info["details_kept"])
        self.assertIn("condition", self.fine("info", self.model()))

    def test_one_is_not_several(self):
        source, model = self.file("in.csv", table([(0, 0), (1, 2), (3, 1), (4, 0)])), self.file("m.ifsm")
        words = self.fine("fit", source, "--no-fit", "--maps", 2, "--control-points", 3, "-o", model)
        self.assertIn("m.ifsm: 1 level, n = 3", words)
        self.assertIn(": 1 point; ", self.fine("synth", model, "--samples", 1, "-o", self.file("out.csv")))

    def test_numbers_have_any_size(self):
        told = {}
        for exponent in (0, 200, -200):
            source, model = self.file("in.csv"), self.file("m.ifsm")
            source.write_text("".join(f"{x!r}e{exponent},{y!r}e{exponent}\n" for x, y in
                                      ((round(x, 4), round(y, 4)) for x, y in rough_ring(100))))
            self.fine("fit", source, "--closed", "--no-fit", "-q", "-o", model)
            sketch = json.loads(self.fine("synth", model, "--details", 20, "--json", "-o", self.file("out.csv")))
            levels = json.loads(self.fine("info", model, "--json"))["energy_by_level"]
            told[exponent] = [sketch["rms"], sketch["max"]] + [level["rms"] for level in levels]
            words = self.fine("info", model)
            self.assertNotIn("nan", words)
            self.assertNotIn("inf ", words)
            self.assertAlmostEqual(sum(float(line.split()[-2]) for line in words.splitlines() if line.endswith("%")), 100,
                                   delta=1)
        for exponent in (200, -200):
            for one, other in zip(told[0], told[exponent]):
                self.assertAlmostEqual(other / 10.0 ** exponent / one, 1, places=9)

    def test_quiet_is_quiet_and_a_pipe_has_no_bar(self):
        source = self.file("in.csv", table(rough_ring(100)))
        options = ("fit", source, "--closed", "--iterations", 3, "--rounds", 1, "-o", self.file("m.ifsm"))
        quiet = run(*options, "-q")
        self.assertEqual((quiet.stdout, quiet.stderr), ("", ""))
        self.assertNotIn("\r", run(*options).stderr)

    def test_a_repeated_last_point_is_told(self):
        points = rough_ring(50)
        source = self.file("in.csv", table(points + points[:1]))
        closed = run("fit", source, "--closed", "--no-fit", "-o", self.file("m.ifsm"))
        self.assertIn("was dropped", closed.stderr)
        self.assertEqual(json.loads(self.fine("info", self.file("m.ifsm"), "--json"))["samples"], 50)
        self.assertIn("add --closed", run("fit", source, "--no-fit", "-o", self.file("m.ifsm")).stderr)

    def test_version_and_help(self):
        self.assertRegex(self.fine("--version"), r"^ifsm \d+\.\d+\.\d+\n$")
        self.assertIn("Exit codes", self.fine("--help"))
        for command in ("fit", "info", "synth", "eval", "plot", "measure", "nearest", "refine", "train"):
            self.assertIn("Examples", self.fine(command, "--help"))


class Gaps(Program):
    points = [(k, k * k % 7) for k in range(12)]

    def log(self, missing):
        rows = [("nan", "") if k in missing else point for k, point in enumerate(self.points)]
        return self.file("log.csv", "x,y\n" + "".join(f"{x},{y}\n" for x, y in rows))

    def samples(self, path):
        return numbers(self.fine("synth", self.file(path)))

    def test_are_refused_with_both_ways_out(self):
        self.refused(3, "log.csv, line 5, column 1 (x): 'nan' is a gap; cut the curve there with --gaps split, go "
                     "straight across with --gaps bridge, or else ", "fit", self.log([3]), "-o", self.file("m.ifsm"))
        self.refused(2, "neither split nor bridge", "fit", self.log([3]), "--gaps", "skip", "-o", self.file("m.ifsm"))

    def test_split_a_curve_into_models(self):
        result = run("fit", self.log([3, 4, 8]), "--gaps", "split", "--no-fit", "--json", "-o", self.file("p-%d.ifsm"))
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertIn("2 gaps, 3 pieces", result.stderr)
        self.assertEqual([model["samples"] for model in json.loads(result.stdout)["models"]], [3, 3, 3])
        for name, piece in (("p-1.ifsm", self.points[:3]), ("p-2.ifsm", self.points[5:8]), ("p-3.ifsm", self.points[9:])):
            self.assertLess(largest_gap(piece, self.samples(name)), 1e-12)

    def test_bridged_stay_one_model(self):
        result = run("fit", self.log([0, 3, 4, 8]), "--gaps", "bridge", "--no-fit", "-o", self.file("m.ifsm"))
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertIn("2 gaps bridged with 3 points", result.stderr)
        self.assertIn("1 point of gaps at the ends cut off", result.stderr)
        back = self.samples("m.ifsm")
        self.assertEqual(len(back), 11)
        self.assertLess(math.dist(back[2], (3, self.points[2][1] + (self.points[5][1] - self.points[2][1]) / 3)), 1e-12)

    def test_several_models_never_share_or_replace_a_file_by_accident(self):
        source, target = self.log([4]), self.file("p-%d.ifsm")
        split = ("fit", source, "--gaps", "split", "--no-fit", "-q")
        before = self.names()
        self.refused(2, ["names one file for 2 curves", "log-%d.ifsm"], *split, "-o", self.file("m.ifsm"))
        self.refused(2, "names one file", *split, "-o", "-")
        self.file("p-2.ifsm", "mine")
        self.refused(4, ["p-2.ifsm", "--overwrite"], *split, "-o", target)
        self.assertEqual(self.names(), before + ["p-2.ifsm"])
        self.assertEqual(self.file("p-2.ifsm").read_text(), "mine")
        self.fine(*split, "--overwrite", "-o", target)
        self.fine(*split, "-o", self.folder)
        self.assertEqual(self.names(), sorted(before + ["log-1.ifsm", "log-2.ifsm", "p-1.ifsm", "p-2.ifsm"]))

    def test_a_ring_with_gaps_falls_into_open_pieces(self):
        result = run("fit", self.log([2, 7]), "--closed", "--gaps", "split", "--no-fit", "-o", self.folder)
        self.assertIn("its pieces are open", result.stderr)
        self.assertLess(largest_gap(self.samples("log-2.ifsm"), self.points[8:] + self.points[:2]), 1e-12)
        self.assertIn("open", result.stdout)


def frames(svg):
    """The closed rectangles that are only stroked: one a panel, and one a colour bar."""
    found = 0
    for path in ElementTree.parse(svg).iter("{http://www.w3.org/2000/svg}path"):
        words = path.get("d", "").split()
        rectangle = len(words) == 15 and words[1:3] == words[13:15] and (words[2], words[4]) == (words[5], words[7])
        found += rectangle and "fill:none" in path.get("style", "")
    return found


def size_of_png(path):
    content = path.read_bytes()
    assert content[:8] == b"\x89PNG\r\n\x1a\n" and content[-8:-4] == b"IEND", content[:16]
    return int.from_bytes(content[16:20], "big"), int.from_bytes(content[20:24], "big")


class Plot(Program):
    def test_the_overview_of_a_model(self):
        svg, png = self.file("p.svg"), self.file("p.png")
        report = json.loads(self.fine("plot", self.model(), "--json", "-q", "-o", svg))
        names = [panel["panel"] for panel in report["panels"]]
        self.assertEqual(names, ["polygon", "attractor", "scalogram", "levels", "budgets", "residuals"])
        self.assertEqual(frames(svg), len(names) + 1)  # the scalogram's colour bar
        self.assertEqual(ElementTree.parse(svg).find("{http://www.w3.org/2000/svg}title").text, "ring.ifsm")
        self.assertIn("polygon, attractor", self.fine("plot", self.model(), "-o", png))
        self.assertEqual(size_of_png(png), (report["width"], report["height"]))

    def test_sizes_and_titles(self):
        png = self.file("p.png")
        for size, expected in ((["--width", 640, "--height", 200], (640, 200)), (["--width", 304], (304, 278))):
            self.fine("plot", self.model(), "--show", "curve", *size, "--title", "A title " * 60, "-q", "-o", png)
            self.assertEqual(size_of_png(png), expected)

    def test_the_numbers_are_those_of_the_other_commands(self):
        model, picture = self.model(), self.file("p.svg")
        report = json.loads(self.fine("plot", model, "--show", "samples,polygon,levels,budgets,residuals", "--details", 20,
                                      "--json", "-q", "-o", picture))
        shown = {panel["panel"]: panel["numbers"] for panel in report["panels"]}
        self.assertEqual([tuple(p) for p in shown["samples"][0]["points"]], numbers(self.fine("synth", model)))
        self.assertEqual([tuple(p) for p in shown["polygon"]["points"]], numbers(self.fine("synth", model, "--level", 0)))
        out = self.file("out.csv")
        for row in shown["levels"][1:3]:
            told = json.loads(self.fine("synth", model, "--levels", row["levels"], "--resolve=values", "--json", "-o", out))
            self.assertAlmostEqual(told["rms"], row["rms"], delta=1e-14 * row["rms"])  # by another way to sum
            self.assertAlmostEqual(told["max"], row["max"], delta=1e-14 * row["max"])
        for row in shown["budgets"][:2]:
            told = json.loads(self.fine("synth", model, "--details", row["budget"] - 5, "--resolve", "--json", "-o", out))
            self.assertAlmostEqual(told["rms"], row["rms"], delta=1e-14 * row["rms"])  # by another way to sum
            self.assertAlmostEqual(told["max"], row["max"], delta=1e-14 * row["max"])
        told = json.loads(self.fine("synth", model, "--details", 20, "--resolve", "--json", "-o", out))
        self.assertAlmostEqual(shown["residuals"]["rms"], told["rms"], delta=1e-14 * told["rms"])
        self.assertEqual(len(shown["residuals"]["distances"]), 300)

    def test_curves_alone(self):
        svg = self.file("p.svg")
        report = json.loads(self.fine("plot", ISLANDS, "--project", "--json", "-q", "-o", svg))
        self.assertEqual([panel["panel"] for panel in report["panels"]], ["samples"])
        self.assertEqual(len(report["panels"][0]["numbers"]), 20)
        faroes, verde = (report["panels"][0]["numbers"][k]["points"][0] for k in (0, 19))
        self.assertGreater(math.dist(faroes, verde), 5000)  # one plane for all
        self.assertEqual(frames(svg), 1)
        piped = subprocess.run([PROGRAM, "plot", "-", "--format", "png", "-o", "-"], input=table(rough_ring(50)).encode(),
                               capture_output=True)
        self.assertEqual(piped.stdout[1:4], b"PNG")
        self.assertEqual(piped.stderr, b"")

    def test_residuals_of_given_samples(self):
        model, source = self.model(), self.file("r.csv", table([(x + 0.5, y) for x, y in rough_ring(300)]))
        show = ("plot", model, "--show", "residuals", "-q", "-o", self.file("p.svg"))
        report = json.loads(self.fine(*show, "--samples-file", source, "--closed", "--json"))
        self.assertAlmostEqual(report["panels"][0]["numbers"]["rms"], 0.5)
        self.refused(3, ["r.csv holds 2 points", "the model 300"], *show, "--samples-file", self.file("r.csv", "0,0\n1,1\n"))

    def test_long_curves_make_no_huge_files(self):
        points = [(math.sin(k * 0.7) * k, math.cos(k * 1.3) * k) for k in range(100000)]
        svg = self.file("p.svg")
        self.fine("fit", self.file("long.csv", table(points)), "--no-fit", "-q", "-o", self.file("long.ifsm"))
        self.fine("plot", self.file("long.ifsm"), "--show", "scalogram", "-q", "-o", svg)
        self.assertLess(svg.stat().st_size, 2_500_000)
        graph = self.file("graph.csv", table([(y,) for _, y in points], "y"))
        self.fine("plot", graph, "-q", "-o", svg)
        self.assertLess(svg.stat().st_size, 500_000)

    def test_misuse(self):
        model, svg = self.model(), self.file("p.svg")
        self.refused(2, ["'levls' is none of", "scalogram"], "plot", model, "--show", "levls", "-o", svg)
        self.refused(2, ["neither .svg nor .png", "--format"], "plot", model, "-o", self.file("p.gif"))
        self.refused(2, ["needs a model", "ifsm fit"], "plot", self.folder / "ring.csv", "--show", "levels", "-o", svg)
        self.refused(2, "leave it out", "plot", self.folder / "ring.csv", "--samples-file", "x.csv", "-o", svg)
        self.refused(2, "--width", "plot", model, "--width", 5, "-o", svg)
        self.refused(2, "standard output", "plot", model, "--format", "svg", "--json", "-o", "-")
        self.refused(4, "cannot be written", "plot", model, "-o", self.folder / "missing" / "p.svg")
        self.refused(3, "is empty", "plot", self.file("e.csv", ""), "-o", svg)
        self.assertFalse(svg.exists())


ISLANDS = pathlib.Path(__file__).parents[2] / "data" / "islands" / "islands.geojson"


def frames_of_webp(path):
    """The sizes and durations of an animation's frames; RIFF chunks as its container specification has them."""
    content = path.read_bytes()
    assert content[:4] == b"RIFF" and content[8:12] == b"WEBP", content[:12]
    at, found = 12, []
    while at < len(content):
        name, size = content[at:at + 4], int.from_bytes(content[at + 4:at + 8], "little")
        if name == b"ANMF":
            found.append(int.from_bytes(content[at + 20:at + 23], "little"))
        at += 8 + size + size % 2
    return found


class Deform(Program):
    def points(self, *bends, name="bent.csv"):
        target = self.file(name)
        self.fine("deform", self.model(), *bends, "-q", "-o", target)
        return numbers(target.read_text())

    def test_nothing_done_changes_nothing(self):
        self.assertEqual(self.points(), numbers(self.fine("synth", self.model())))

    def test_moves_by_and_to(self):
        control = numbers(self.fine("synth", self.model(), "--level", 0))
        for way in ("+0.5,-0.25", f"={control[2][0] + 0.5!r},{control[2][1] - 0.25!r}"):
            bent = self.file("bent.ifsm")
            self.fine("deform", self.model(), "--move", f"2:{way}", "-q", "-o", bent)
            moved = numbers(self.fine("synth", bent, "--level", 0))
            for k, (a, b) in enumerate(zip(control, moved)):
                wanted = (a[0] + 0.5, a[1] - 0.25) if k == 2 else a
                self.assertLess(math.dist(b, wanted), 1e-12)

    def test_a_dragged_point_arrives_and_the_pinned_stay(self):
        bent = self.file("bent.ifsm")
        before = numbers(self.fine("eval", self.model(), "--at", "0.3,0.8"))
        self.fine("deform", self.model(), "--move-at", "0.3:+0.1,0.2;0.8:+0,0@4", "-q", "-o", bent)
        after = numbers(self.fine("eval", bent, "--at", "0.3,0.8"))
        for a, b, by in zip(before, after, [(0.1, 0.2), (0, 0)]):
            self.assertLess(math.dist(b[1:], (a[1] + by[0], a[2] + by[1])), 1e-9)

    def test_edits_are_made_in_their_order(self):
        there = self.points("--scale-details", "0.5@2", "--texture", "random=0.7,3@2")
        back = self.points("--texture", "random=0.7,3@2", "--scale-details", "0.5@2")
        self.assertNotEqual(there, back)
        self.assertEqual(self.points("--texture", "random=0.7,3@2"), there)  # texture takes the place of what was scaled
        self.assertEqual(self.points("--scale-details", "0"), self.points("--scale-details", "0@first7"))

    def test_kept_edits_are_made_again_on_the_same_model_alone(self):
        bends = ("--during", "0,2,linear", "--move", "1/3:+1,1@smooth=2,length", "--pin", "2/5,6", "--turn-details",
                 "30@last2~1", "--mirror-details", "y@1-2")
        wanted = self.points(*bends)
        for name in ("e.json", "e.cbor"):
            self.fine("deform", self.model(), *bends, "--keep-edits", self.file(name), "-q", "-o", self.file("b.csv"))
            self.assertEqual(self.points("--edits", self.file(name)), wanted)
        other = self.model("other.ifsm") and self.file("bent.ifsm")
        self.fine("deform", self.model(), *bends, "-q", "-o", other)
        self.refused(3, ["e.json", "another model"], "deform", other, "--edits", self.file("e.json"), "-o", self.file("x.csv"))
        self.assertFalse(self.file("x.csv").exists())

    def test_pictures_and_films(self):
        svg, png, film = self.file("b.svg"), self.file("b.png"), self.file("b.webp")
        self.fine("deform", self.model(), "--move", "2:+1,0", "-q", "-o", svg)
        self.assertEqual(frames(svg), 1)
        self.fine("deform", self.model(), "--move", "2:+1,0", "--width", 300, "--height", 200, "-q", "-o", png)
        self.assertEqual(size_of_png(png), (300, 200))
        during = ("--during", "0,1", "--move", "2:+1,0", "--during", "1,2", "--scale-details", 0)
        report = json.loads(self.fine("deform", self.model(), *during, "--frames", 6, "--rate", 10, "--width", 300, "-q",
                                      "--json", "-o", film))
        self.assertEqual(frames_of_webp(film), [100] * 6)
        self.assertEqual((report["edits"], report["frames"]), (2, 6))
        self.fine("deform", self.model(), *during, "--frames", 3, "--width", 300, "-q", "-o", self.file("f-%02d.png"))
        self.assertEqual([name for name in self.names() if name.startswith("f-")], ["f-01.png", "f-02.png", "f-03.png"])
        self.assertNotEqual(self.file("f-01.png").read_bytes(), self.file("f-03.png").read_bytes())

    def test_what_is_read_is_never_replaced(self):
        model, edits, other = self.model(), self.file("e.json"), self.file("other.ifsm")
        self.fine("deform", model, "--move", "2:+1,1", "--keep-edits", edits, "-q", "-o", other)
        kept = {path: path.read_bytes() for path in (model, edits, other)}
        for arguments in [("--edits", edits, "-o", edits), ("--texture", f"{other}@last2", "-o", other),
                          ("--texture", f"{other}@last2", "-o", self.file("t.csv"), "--keep-edits", other),
                          ("--edits", edits, "-o", self.file("t.csv"), "--keep-edits", edits),
                          ("-o", self.file("t.csv"), "--keep-edits", model),
                          ("-o", self.file("t.csv"), "--keep-edits", self.file("t.csv")),
                          ("--frames", 3, "-o", self.file("q-%d.png"), "--keep-edits", self.file("q-2.png")),
                          ("-o", self.file("t.csv"), "--keep-edits", "-"),
                          ("-o", self.file("t.csv"), "--keep-edits", "")]:
            with self.subTest(arguments=arguments):
                self.refused(2, "ifsm: ", "deform", model, "-q", *arguments)
        self.assertEqual(kept, {path: path.read_bytes() for path in kept})
        self.assertEqual(self.names(), ["e.json", "other.ifsm", "ring.csv", "ring.ifsm"])

    def test_edits_are_made_again_as_they_were_made(self):
        bends, edits = ("--move", "2:+1,0", "--move", "1/3:+0,1"), self.file("e.json")
        turned = ("--turning", "rotation", "--follow", "each")
        wanted = self.points(*turned, *bends, "--keep-edits", edits)
        self.assertNotEqual(wanted, self.points(*bends))
        self.assertEqual(self.points("--edits", edits), wanted)
        self.refused(3, ['"rotation" and follow "each"', '"similarity" and "moved"'], "deform", self.model(), "--edits",
                     edits, "--turning", "similarity", "-o", self.file("x.csv"))

    def test_a_curve_beyond_the_doubles_is_no_result(self):
        far = ("--move", "0,1,2:+1.7e308,0")
        for name in ("z.csv", "z.svg", "z.ifsm"):
            self.refused(2, "beyond the range of doubles", "deform", self.model(), *far, *far, "-o", self.file(name))
        self.refused(2, "roughness is -200", "deform", self.model(), "--texture", "random=-200", "-o", self.file("z.csv"))
        self.assertEqual(self.names(), ["ring.csv", "ring.ifsm"])

    def test_crossings_that_edits_caused_are_told(self):
        tell = lambda *bends: json.loads(self.fine("deform", self.model(), *bends, "--json", "-q", "-o", self.file("b.csv")))
        self.assertEqual(tell()["crossings"], 0)
        self.assertGreater(tell("--move", "3/4:+400,-300")["crossings"], 0)

    def test_misuse(self):
        model, target = self.model(), self.file("x.ifsm")
        still = ("--move", "2:+0,0")
        for words, *bends in [
                ("--move 2:10,4: '10,4' is no way: begin it with +", "--move", "2:10,4"),
                ("--move 2: '2' has no colon", "--move", "2"),
                ("--move :+1,1: '' is not a handle's number", "--move", ":+1,1"),
                ("--move 2:+1: the curve has dimension 2", "--move", "2:+1"),
                ("--move 2:+1,nan: 'nan' is not a number", "--move", "2:+1,nan"),
                ("--move 2:+1,1@near=2: 'near=2' is none of smooth=RADIUS", "--move", "2:+1,1@near=2"),
                ("--move 99:+1,1: handles[0] is 99; level 0 has handles 0 to ", "--move", "99:+1,1"),
                ("--move 77/0:+1,1: level is 77", "--move", "77/0:+1,1"),
                ("--move 2:+1,1@smooth=-1: radius is -1", "--move", "2:+1,1@smooth=-1"),
                ("--move-at 1:+1,1;1:+2,2@3: ", "--move-at", "1:+1,1;1:+2,2@3"),
                ("--pin 1/x: 'x' is not a handle's number", "--pin", "1/x"),
                ("--move 1/2:+1,1: handles[0] is 2, which is pinned", "--pin", "1/2", "--move", "1/2:+1,1"),
                ("--scale-details x: 'x' is not a number", "--scale-details", "x"),
                ("--scale-details 2@x: 'x' is not a level of details, or levels: 3, 2-5", "--scale-details", "2@x"),
                ("--move 2:+1,1@length: length says what RADIUS is", "--move", "2:+1,1@length"),
                ("--move 2:+1,1@smooth=1,linear=2: smooth and linear do not", "--move", "2:+1,1@smooth=1,linear=2"),
                ("--move : is empty", "--move", ""),
                ("--rate: '1e-5' is not a number from 0.01 to 1000", "--rate", "1e-5"),
                ("--scale-details 2@last99: 'last99': the model has ", "--scale-details", "2@last99"),
                ("--scale-details 2@5-3: last is 3", "--scale-details", "2@5-3"),
                ("--mirror-details z: 'z' is no axis", "--mirror-details", "z"),
                ("--texture random=0.5,1,2: random takes", "--texture", "random=0.5,1,2"),
                ("--during 2,1: end is 1 and begin 2", "--during", "2,1", *still),
                ("--during 2: give a begin and an end", "--during", "2", *still),
                ("--during 0,1,slow: 'slow' is none of smooth, linear, in, out", "--during", "0,1,slow", *still),
                ("--during 0,1: say it before the edits", *still, "--during", "0,1"),
                ("--move needs a value", "--move")]:
            with self.subTest(bends=bends):
                self.refused(2, "ifsm: " + words, "deform", model, "-o", target, *bends)
        for words, output, *more in [("is an animation; add --frames", "b.webp"),
                                     ("--frames makes pictures", "b.ifsm", "--frames", 3),
                                     ("--frames makes pictures, and --format", "b.webp", "--frames", 3, "--format", "json"),
                                     ("put %d", "b-%s.png", "--frames", 3), ("put %d", "b-%d%d.png", "--frames", 3),
                                     ("ends in none of .ifsm, .json", "b.jpg"),
                                     ("names one file for 3 pictures; put %d", "b.png", "--frames", 3)]:
            self.refused(2, words, "deform", model, "--move", "2:+1,1", "-q", "-o", self.file(output), *more)
        self.refused(3, "none.ifsm", "deform", model, "--texture", self.file("none.ifsm"), "-o", target)
        self.assertEqual(self.names(), ["ring.csv", "ring.ifsm"])


class GeoJson(Program):
    def rings(self):
        features = json.loads(ISLANDS.read_text())["features"]
        return [ring for feature in features for polygon in feature["geometry"]["coordinates"] for ring in polygon]

    def test_every_ring_becomes_a_model_that_gives_it_back(self):
        report = json.loads(self.fine("fit", ISLANDS, "--no-fit", "--json", "-q", "-o", self.folder))
        rings = self.rings()
        self.assertEqual(len(report["models"]), len(rings))
        self.assertEqual(report["models"][0]["curve"], "Faroe Islands")
        self.assertEqual(self.names()[0], "islands-01-Faroe_Islands.ifsm")
        self.assertEqual(len(self.names()), len(rings))
        for model, ring in list(zip(report["models"], rings))[::6]:
            self.assertTrue(model["closed"])
            self.assertLess(largest_gap(numbers(self.fine("synth", model["output"])), ring[:-1]), 1e-12)

    def test_faults_of_rings_are_told_and_read(self):
        def told(*rings):
            path = self.file("rings.geojson", json.dumps({"type": "Polygon", "coordinates": rings}))
            return run("fit", path, "--no-fit", "--overwrite", "-o", self.file("ring-%d.ifsm")).stderr

        square = lambda low, high: [[low, low], [high, low], [high, high], [low, high], [low, low]]
        self.assertEqual(told(square(0, 9), square(1, 2), square(3, 4)), "")
        self.assertEqual(told(square(0, 9), square(1, 2), square(2, 4)), "")  # holes that touch are none
        self.assertIn("coordinates[0]: this ring meets itself in 1 place, first at 1, 1;",
                      told([[0, 0], [2, 2], [2, 0], [0, 2], [0, 0]]))
        self.assertIn("coordinates[1]: this hole lies outside its polygon;", told(square(0, 9), square(10, 12)))
        self.assertIn("coordinates[2]: this hole and another one of its polygon overlap;",
                      told(square(0, 9), square(1, 8), square(2, 3)))
        self.assertIn("coordinates[2]: this hole and another", told(square(0, 9), square(2, 3), square(1, 8)))
        many = told(square(0, 9), *[square(10, 12 + k) for k in range(8)])
        self.assertIn("10 more faults of rings like these", many)
        self.assertIn("coordinates[1]: this hole does not lie within its polygon, or only in part;", told(square(0, 9), square(8, 12)))
        notch = [[0, 0], [9, 0], [9, 9], [5, 9], [5, 4], [4, 4], [4, 9], [0, 9], [0, 0]]
        self.assertIn("coordinates[1]: this hole does not lie within", told(notch, square(3, 6)))
        self.assertIn("coordinates[1]: this hole does not lie within", told(square(0, 9), square(0, 9)))
        touching = [[0, 5], [5, 0], [10, 5], [5, 10], [0, 5]], [[0, 5], [5, 0], [10, 5], [0, 5]], [[0, 0], [10, 10], [5, 10], [0, 0]]
        for hole in touching:  # at points, or along an edge
            self.assertEqual(told(square(0, 10), hole), "")
        bar = lambda x, y: [[-x, -y], [x, -y], [x, y], [-x, y], [-x, -y]]
        self.assertIn("coordinates[2]: this hole and another", told(square(-9, 9), bar(5, 1), bar(1, 5)))

    def test_polygons_of_one_shape_are_held_against_each_other(self):
        def told(*polygons):
            path = self.file("rings.geojson", json.dumps({"type": "MultiPolygon", "coordinates": polygons}))
            return run("fit", path, "--no-fit", "--overwrite", *options, "-o", self.file("ring-%d.ifsm")).stderr

        options = []
        square = lambda low, high: [[low, low], [high, low], [high, high], [low, high], [low, low]]
        self.assertEqual(told([square(0, 2)], [square(3, 5)], [square(5, 7)]), "")  # the last two touch
        self.assertEqual(told([square(0, 9), square(2, 6)], [square(3, 5)]), "")  # an island in a lake
        self.assertEqual(told([square(3, 5)], [square(0, 9), square(2, 6)]), "")
        for polygons in ([square(0, 9)], [square(3, 5)]), ([square(3, 5)], [square(0, 9)]), ([square(0, 4)], [square(3, 9)]):
            self.assertIn("coordinates[1][0]: this polygon and another one of its MultiPolygon overlap;", told(*polygons))
        options = ["--project=180,0"]
        shell = [[170, 0], [-170, 0], [-170, 9], [170, 9], [170, 0]]
        lake = [[-179, 2], [-178, 2], [-178, 3], [-179, 3], [-179, 2]]
        self.assertNotIn("hole", told([shell, lake]))

    def test_projected_and_back(self):
        report = json.loads(self.fine("fit", ISLANDS, "--project", "--no-fit", "--json", "-q", "-o", self.file("i-%d")))
        for model, ring in list(zip(report["models"], self.rings()))[::6]:
            middle = "{longitude},{latitude}".format(**model["middle"])
            told = json.loads(self.fine("synth", model["output"], "--geojson", "--unproject=" + middle))
            self.assertEqual(told["geometry"]["type"], "Polygon")
            self.assertLess(largest_gap(told["geometry"]["coordinates"][0], ring), 1e-12)
            # Somewhere near the true size: a degree of latitude is 111 km.
            heights = [y for _, y in ring]
            diagonal = json.loads(self.fine("info", model["output"], "--json"))["diagonal"]
            self.assertGreater(diagonal, 111 * (max(heights) - min(heights)))

    def test_one_plane_for_all_keeps_them_in_their_places(self):
        faroes = self.file("f.geojson", json.dumps(json.loads(ISLANDS.read_text())["features"][0]))
        self.fine("fit", faroes, "--project=-6.9,61.9", "--no-fit", "-q", "-o", self.file("f-%02d.json"))
        points = numbers(self.fine("synth", self.file("f-05.json")))
        lon, lat = self.rings()[4][0]
        self.assertAlmostEqual(points[0][0], 111.195080 * (lon + 6.9) * math.cos(math.radians(61.9)), places=4)
        self.assertAlmostEqual(points[0][1], 111.195080 * (lat - 61.9), places=4)

    def test_altitudes_are_metres_beside_kilometres(self):
        line = {"type": "LineString", "coordinates": [[10, 60, 100], [10.1, 60.1, 250], [10.2, 60, 300]]}
        source, model = self.file("track.geojson", json.dumps(line)), self.file("m.ifsm")
        self.fine("fit", source, "--project", "--no-fit", "-o", model)
        for altitude, point in zip((0.1, 0.25, 0.3), numbers(self.fine("synth", model))):
            self.assertAlmostEqual(point[2], altitude)
        told = json.loads(self.fine("synth", model, "--geojson", "--unproject", "10.1,60.05"))
        self.assertLess(largest_gap(told["geometry"]["coordinates"], line["coordinates"]), 1e-9)
        self.fine("fit", source, "--flat", "--no-fit", "-o", model)
        self.assertEqual(json.loads(self.fine("info", model, "--json"))["dimension"], 2)

    def test_across_the_180th_meridian(self):
        line = {"type": "LineString", "coordinates": [[179, 1], [-179, 2], [-178, 1]]}
        self.fine("fit", self.file("d.geojson", json.dumps(line)), "--project", "--no-fit", "-o", self.file("m.ifsm"))
        points = numbers(self.fine("synth", self.file("m.ifsm")))
        self.assertLess(points[2][0] - points[0][0], 3 * 111.2)
        self.assertGreater(points[1][0], points[0][0])

    def test_tables_are_projected_too(self):
        source = self.file("t.csv", "lat,lon\n60,10\n60.1,10.1\n60,10.2\n")
        self.fine("fit", "--project", source, "--columns", "lon,lat", "--no-fit", "-o", self.file("m.ifsm"))
        self.assertAlmostEqual(numbers(self.fine("synth", self.file("m.ifsm")))[1][0], 0, places=9)
        self.refused(3, ["point 1 is 200, 100", "in that order"], "fit", self.file("xy.csv", "200,100\n0,0\n"),
                     "--project", "-o", self.file("x.ifsm"))

    def test_misuse(self):
        target = self.file("m.ifsm")
        ring = {"type": "Polygon", "coordinates": [[[0, -70], [120, -70], [-120, -70], [0, -70]]]}
        self.refused(3, "runs round a pole", "fit", self.file("a.geojson", json.dumps(ring)), "--project", "-o", target)
        long = {"type": "LineString", "coordinates": [[0, 10], [0, 80]]}
        self.refused(3, "wrong by more than a factor of two", "fit", self.file("l.geojson", json.dumps(long)),
                     "--project", "-o", target)
        self.refused(2, "no columns", "fit", ISLANDS, "--columns", "lon,lat", "-o", target)
        self.refused(2, ["names one file for 20 curves", "islands-%d.ifsm"], "fit", ISLANDS, "-o", target)
        self.refused(2, "'x' is no longitude and latitude", "fit", ISLANDS, "--project=x", "-o", target)
        self.refused(3, "a Point is no curve", "fit", self.file("p.geojson", '{"type": "Point", "coordinates": [1, 2]}'),
                     "-o", target)
        self.assertFalse(target.exists())
        source = self.file("one.csv", "1\n2\n4\n")
        self.fine("fit", source, "--no-fit", "-q", "-o", target)
        self.refused(2, "2 or 3 coordinates", "synth", target, "--geojson")
        self.refused(2, "two columns", "fit", source, "--project", "-o", self.file("n.ifsm"))

    def test_a_signal_leaves_none_of_several(self):
        features = [{"type": "Feature", "geometry": {"type": "Polygon", "coordinates": [rough_ring(9000)]}}] * 40
        source = self.file("many.geojson", json.dumps({"type": "FeatureCollection", "features": features}))
        process = subprocess.Popen([PROGRAM, "fit", source, "-q", "-o", self.file("m-%d.ifsm")],
                                   stderr=subprocess.PIPE, preexec_fn=default_signals)
        time.sleep(1.5)
        self.assertIsNone(process.poll())
        process.send_signal(signal.SIGINT)
        process.communicate(timeout=60)
        self.assertEqual(process.returncode, 130)
        self.assertEqual(self.names(), ["many.geojson"])


class Misuse(Program):
    def test_usage(self):
        source, target, model = self.file("in.csv", "x,y\n0,0\n1,1\n2,0\n"), self.file("m.ifsm"), self.model()
        fit = ("fit", source, "-o", target)
        self.refused(2, "ifsm: a command is missing: fit, info, ")
        self.refused(2, "--nonsense", *fit, "--nonsense")
        self.refused(2, "--output", "fit", source)
        self.refused(2, ["--control-points", "or auto"], *fit, "--control-points", "99")
        self.refused(2, "auto", *fit, "--maps", "2x")
        self.refused(2, "--budget", *fit, "--budget", "0")
        self.refused(2, "--no-fit", *fit, "--no-fit", "--budget", "8")
        self.refused(2, "only one", *fit, "--filter", "casteljau", "--maps", "auto")
        self.refused(2, ["--filter", "casteljau", "koch"], *fit, "--filter", "unknown")
        self.refused(2, ["joined", "--no-fit"], *fit, "--filter", "haar")
        self.refused(2, "--json", "fit", source, "-o", "-", "--format", "json", "--json")
        self.refused(2, "no column 'z'", *fit, "--columns", "x,z")
        self.refused(2, "--resolve", "synth", model, "--resolve")
        self.refused(2, "--levels", "synth", model, "--levels", "1", "--details", "3")
        self.refused(2, "the levels 0 to", "synth", model, "--level", "99")
        self.refused(2, "separator", "synth", model, "--separator", "pipe")
        self.refused(2, "--params", "eval", model)
        self.refused(2, "cannot both", "eval", "-", "--at", "-", stdin="")
        self.refused(2, "--at", "eval", model, "--at", "0.5,x")
        self.assertFalse(target.exists())

    def test_every_usage_fault_is_one_sentence_of_the_program(self):
        points, model, target = self.file("in.csv", table(rough_ring(20))), self.model(), self.file("m.ifsm")
        fit = ("fit", points, "-o", target)
        whole = "is not a whole number from "
        for words, *arguments in [
                ("'foo' is none of the commands fit, info, ", "foo"),
                ("'--nonsense' is none of the commands ", "--nonsense", "fit"),
                ("fit needs curves", "fit"),
                ("fit needs --output", "fit", points),
                ("--output needs a value", "fit", points, "-o"),
                ("--output is given more than once", *fit, "-o", target),
                ("fit has no option --nonsense", *fit, "--nonsense"),
                ("fit does not expect 'b'", *fit, "b", "c"),
                ("--closed: 'maybe' is no value", *fit, "--closed=maybe"),
                ("--levels and --details do not go together", "synth", model, "--details", 3, "--levels", 1),
                ("--format: 'xml' is none of json, cbor", *fit, "--format", "xml"),
                *((f"--budget: '{value}' {whole}1 to 9223372036854775807", *fit, "--budget", value)
                  for value in ("-1", "0", "1e9", "0x10", "8.5", "99999999999999999999")),
                (f"--samples: '0' {whole}1 to 2147483647", "synth", model, "--samples", 0),
                (f"--maps: '9' {whole}2 to 8, or auto", *fit, "--maps", 9),
                *((f"--threshold: '{value}' is not a number from 0 on", "synth", model, "--threshold", value)
                  for value in ("nan", "inf", "-1", "1e999", "x")),
                ("--condition: '0' is not a number above 0", "train", points, "-o", target, "--condition", 0),
                ("--columns: '-q' is no column", *fit, "--columns", ",", "-q"),
                ("--columns names 5 columns; a curve has 1 to 4.", *fit, "--columns", "2,1,2,1,2"),
                ("--levels: the model has 7 levels; give a number from 0 to 7.", "synth", model, "--levels", 8),
                ("--details: the model has ", "synth", model, "--details", 100000),
                ("--control-points, --maps: A filter", *fit, "-q", "--control-points", 8, "--maps", 8),
                ("--control-points, --maps: A filter", "train", *fit[1:], "-q", "--control-points", 8, "--maps", 8),
                ("--filter: The filter \"koch\" has 3 control points", *fit, "--filter", "koch", "--maps", 2),
                ("--at: 'abc' is no list of numbers", "eval", model, "--at", "abc"),
                ("--at: '0.1,,0.2' is no list of numbers", "eval", model, "--at", "0.1,,0.2"),
                ("--levels: A tree", "refine", model, "--levels", 40, "-o", target)]:
            with self.subTest(arguments=arguments):
                result = run(*arguments)
                self.assertEqual((result.returncode, result.stdout), (2, ""), result.stderr)
                self.assertTrue(result.stderr.startswith("ifsm: " + words), result.stderr)
                self.assertEqual(result.stderr.count("\n"), 1, result.stderr)
                self.assertNotIn("give 0", result.stderr)
        self.assertFalse(target.exists())

    def test_numbers_are_decimal(self):
        self.assertEqual(len(numbers(self.fine("synth", self.model(), "--samples", "010"))), 10)

    def test_points_where_a_model_is_wanted(self):
        self.model()
        for command in ("info", "measure", "synth"):
            self.refused(3, ["ring.csv is a table of points, not a model; fit it first: ifsm fit "], command,
                         self.file("ring.csv"))
        self.refused(3, "islands.geojson is GeoJSON, not a model", "info", ISLANDS)
        self.refused(3, "fit it first: ifsm fit - -o", "info", "-", stdin="1,2\n3,4\n")

    def test_tables_that_are_none(self):
        target = self.file("m.ifsm")
        for text, words in [("", "is empty"), ("3,14;2,7\n1;2\n", ["line 1, column 1", "'3,14'", "decimal comma"]),
                            ("x,y\n1,2\n3\n", ["line 3", "1 value where line 1 has 2"]),
                            ("1,2\n3,nan\n", ["line 2, column 2", "'nan'"]), ("1,2\n,3\n", ["line 2, column 1", "empty"]),
                            ("1,2\n", "one point"), ("1,2,3,4,5\n6,7,8,9,10\n", ["5 columns", "--columns"])]:
            self.refused(3, words, "fit", self.file("in.csv", text), "-o", target)
        self.refused(3, "binary", "fit", self.model(), "-o", target)
        self.refused(3, "is a directory", "fit", self.folder, "-o", target)
        self.refused(3, ["missing.csv", "cannot be opened"], "fit", self.file("missing.csv"), "-o", target)
        self.assertFalse(target.exists())

    @unittest.skipIf(os.geteuid() == 0, "root reads everything")
    def test_an_unreadable_table(self):
        source = self.file("in.csv", "1,2\n3,4\n")
        source.chmod(0)
        self.refused(3, "cannot be opened", "fit", source, "-o", self.file("m.ifsm"))

    def test_models_that_are_none(self):
        whole = self.model().read_bytes()
        for name, content in [("empty", b""), ("table", b"x,y\n1,2\n"), ("cut", whole[: len(whole) // 2])]:
            path = self.folder / name
            path.write_bytes(content)
            self.refused(3, name, "info", path)
        self.refused(3, "is a directory", "synth", self.folder)

    def test_parameters_out_of_range(self):
        source, model = self.file("in.csv", "0,0\n1,1\n2,0\n"), self.file("m.ifsm")
        self.fine("fit", source, "--no-fit", "-q", "-o", model)
        self.refused(2, ["parameter 2 is 1.5", "0 to 1"], "eval", model, "--at", "0.5,1.5")
        self.refused(3, "parameter 1 is -1", "eval", model, "--at", "-", stdin="-1\n")


class Output(Program):
    def test_a_target_that_cannot_be_written_is_known_at_once(self):
        source = self.file("in.csv", table(rough_ring(60)))
        before = self.names()
        self.refused(4, "cannot be written", "fit", source, "--no-fit", "-q", "-o", self.folder / "missing" / "m.ifsm")
        self.refused(4, "is a directory", "synth", self.model(), "-o", self.folder)
        before = self.names()
        self.refused(4, "cannot be written", "fit", source, "--no-fit", "-q", "-o", str(self.folder / "missing") + "/")
        self.refused(4, "cannot be written", "fit", source, "--no-fit", "-q", "-o", "/dev/full")
        self.assertEqual(self.names(), before)

    def test_a_write_that_fails_leaves_what_was_there(self):
        model, target = self.model(), self.file("out.csv", "before")
        before = self.names()
        limit = lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (1000, 1000))
        self.refused(4, "out.csv cannot be written", "synth", model, "-o", target, preexec_fn=limit)
        self.assertEqual(target.read_text(), "before")
        self.assertEqual(self.names(), before)

    def test_standard_output_that_is_full(self):
        with open("/dev/full", "w") as full:
            for arguments in (["synth", self.model()], ["info", self.model()]):
                result = subprocess.run([PROGRAM, *map(str, arguments)], stdout=full, stderr=subprocess.PIPE, text=True)
                self.assertEqual(result.returncode, 4, result.stderr)
                self.assertIn("standard output", result.stderr)

    def test_standard_output_is_written_to_under_any_name(self):
        model, log = self.model(), self.file("log.txt")
        table = self.fine("synth", model, "--samples", 2)
        for name in ("/dev/stdout", "/dev/fd/1", "/proc/self/fd/1", "/dev/stderr"):
            with open(log, "w") as output:
                for write in (lambda: os.write(output.fileno(), b"before\n"),
                              lambda: subprocess.run([PROGRAM, "synth", model, "--samples", "2", "-o", name], check=True,
                                                     stdout=output, stderr=output),
                              lambda: os.write(output.fileno(), b"after\n")):
                    write()
            self.assertEqual(log.read_text(), "before\n" + table + "after\n", name)
        self.refused(2, "standard output", "synth", model, "--json", "-o", "/dev/stdout")

    def test_an_input_is_not_replaced(self):
        model, points = self.model(), self.folder / "ring.csv"
        before = {name: self.file(name).read_bytes() for name in self.names()}
        for arguments in (("fit", points, "--closed", "--no-fit", "-o", points), ("synth", model, "-o", model),
                          ("refine", model, "-o", model), ("train", points, points, "-o", points),
                          ("eval", model, "--params", points, "-o", points), ("nearest", model, points, "-o", points),
                          ("plot", model, "--format", "svg", "-o", model)):
            self.refused(2, "is the file that is read", *arguments)
        with open(model) as stdin:
            result = subprocess.run([PROGRAM, "synth", "-", "-o", str(model)], stdin=stdin, capture_output=True, text=True)
        self.assertEqual(result.returncode, 2)
        self.assertIn("(standard input)", result.stderr)
        self.assertEqual({name: self.file(name).read_bytes() for name in self.names()}, before)

    def test_paths_that_lead_nowhere(self):
        model = self.model()
        self.file("loop").symlink_to("loop")
        before = self.names()
        for name, words in (("x" * 300, "too long"), ("loop", "symbolic links"), ("ring.csv/x", "ot a directory")):
            self.refused(4, words, "synth", model, "-o", self.file(name))
            self.refused(4, words, "fit", self.file("ring.csv"), "--no-fit", "-o", self.file(name))
        self.refused(2, "-o '' names no file", "synth", model, "-o", "")
        self.assertEqual(self.names(), before)

    def test_names_need_not_be_utf_8(self):
        points, model = os.fsencode(self.model().with_name("ring.csv")), os.fsencode(self.folder / "m") + b"\xff.ifsm"
        picture = os.fsencode(self.folder / "p") + b"\xff.svg"
        for arguments in ([b"fit", points, b"--no-fit", b"--json", b"-o", model],
                          [b"plot", model, b"--show", b"curve", b"--json", b"-q", b"-o", picture]):
            result = subprocess.run([PROGRAM, *arguments], capture_output=True)
            self.assertEqual((result.returncode, result.stderr.replace(b"\xff", b"")), (0, b""))
            self.assertIn("\ufffd", json.loads(result.stdout.decode())["output"])

    @unittest.skipIf("SANITIZED" in os.environ, "sanitizers reserve more address space than the limit")
    def test_too_little_memory_is_a_sentence(self):
        model = self.model()
        limit = lambda: resource.setrlimit(resource.RLIMIT_AS, (1 << 30, 1 << 30))
        before = self.names()
        self.refused(1, "ifsm: there is not enough memory", "synth", model, "--samples", 2147483647, "-o",
                     self.file("big.csv"), preexec_fn=limit)
        self.assertEqual(self.names(), before)

    def test_stages_fit_alone_and_give_exact_models(self):
        points = rough_ring(200)
        source, model, back = self.file("in.csv", table(points)), self.file("m.ifsm"), self.file("out.csv")
        for stage, details in ("curve", 0), ("filter", (1 + 2) * 4):
            extra = ("--levels", 2) if stage == "filter" else ()
            report = json.loads(self.fine("fit", source, "--closed", "--stage", stage, *extra, "--json", "-q", "-o", model))
            (row,) = report["fit"]["budgets"]
            self.assertEqual(row["details"], details)
            self.assertLess(row["rms"], row["start_rms"])
            self.fine("synth", model, "-o", back)
            self.assertLess(largest_gap(points, numbers(back.read_text())), 1e-9)
        self.refused(2, "--budget", "fit", source, "--stage", "curve", "--budget", 8, "-o", model)
        self.refused(2, "--levels", "fit", source, "--levels", 2, "-o", model)


class Questions(Program):
    def test_a_curve_is_measured(self):
        points = rough_ring(300)
        told = json.loads(self.fine("measure", self.model(), "--json"))
        length = sum(math.dist(p, q) for p, q in zip(points, points[1:] + points[:1]))
        self.assertAlmostEqual(told["length"], length, delta=1e-9 * length)
        self.assertEqual(told["self_intersections"], 0)
        for method in ("boxes", "divider"):
            self.assertEqual(len(told[method]["scales"]), 12)
            self.assertTrue(0.9 < told[method]["dimension"] < 1.5, told[method]["dimension"])
        self.assertEqual(len(told["roughness"]["levels"]), json.loads(self.fine("info", self.model(), "--json"))["levels"])
        words = self.fine("measure", self.model())
        for word in ("length", "self-intersections", "box dimension", "divider dimension", "RMS"):
            self.assertIn(word, words)

    def test_what_has_no_answer_is_null(self):
        model = self.file("profile.ifsm")
        self.fine("fit", "-", "--no-fit", "-q", "-o", model, stdin="y\n0\n1\n0\n2\n")
        told = json.loads(self.fine("measure", model, "--json"))
        self.assertIsNone(told["self_intersections"])
        self.assertIsNone(told["boxes"])
        self.assertIsNotNone(told["divider"])
        self.assertIn("self-intersections  -", self.fine("measure", model))

    def test_nearest_points_are_a_table(self):
        points = rough_ring(300)
        rows = self.fine("nearest", self.model(), "-", stdin=table(points)).splitlines()
        self.assertEqual(rows[0], "t,distance,x,y")
        for point, row in zip(points, numbers("\n".join(rows[1:]))):
            self.assertLess(row[1], 1e-9)
            self.assertLess(math.dist(point, row[2:]), 1e-9)
        self.refused(3, ["3 columns", "--columns"], "nearest", self.model(), "-", stdin="1,2,3\n")
        self.refused(2, "both", "nearest", "-", "-", stdin="1,2\n")

    def test_refining_is_seeded_and_keeps_the_samples(self):
        model, finer, other = self.model(), self.file("finer.json"), self.file("other.json")
        told = json.loads(self.fine("refine", model, "--levels", 2, "--seed", 3, "--json", "-o", finer))
        self.assertEqual(told["places"], 4 * json.loads(self.fine("info", model, "--json"))["places"])
        self.assertGreater(told["length"], told["length_before"])
        self.fine("refine", model, "--levels", 2, "--seed", 3, "-o", other)
        self.assertEqual(finer.read_bytes(), other.read_bytes())
        self.fine("refine", model, "--levels", 2, "--seed", 4, "-q", "-o", other)
        self.assertNotEqual(finer.read_bytes(), other.read_bytes())
        smooth = json.loads(self.fine("refine", model, "--roughness", 0, "--json", "-o", other))
        self.assertAlmostEqual(smooth["length"], smooth["length_before"], delta=1e-9 * smooth["length"])
        places = self.file("near.csv")
        self.fine("nearest", finer, "-", "-o", places, stdin=table(rough_ring(300)))
        self.assertLess(max(row[1] for row in numbers(places.read_text())), 1e-9)
        self.refused(2, "--levels", "refine", model, "--levels", 0, "-o", other)
        square = self.file("square.ifsm")
        self.fine("fit", "-", "--filter", "haar", "--no-fit", "-q", "-o", square, stdin=table(rough_ring(20)))
        self.refused(1, "joined", "refine", square, "-o", other)


class Train(Program):
    def family(self):
        return [self.file(f"{k}.csv", table(rough_ring(200 + 10 * k))) for k in range(4)]

    def test_a_filter_is_trained_told_of_and_fitted_with(self):
        report = self.fine("train", *self.family(), "--closed", "--control-points", 4, "--rounds", 2, "--hold-out", 4,
                             "-o", self.file("f.json"), "--json")
        report = json.loads(report)
        self.assertEqual((report["trained"], report["held_out"], report["control_points"]), (3, 1, 4))
        self.assertLessEqual(report["ratio"], 1)
        self.assertGreater(report["held_out_ratio"], 0)
        self.fine("fit", self.file("0.csv"), "--closed", "--no-fit", "--filter", self.file("f.json"), "-o",
                    self.file("m.json"))
        self.assertEqual(json.loads(self.file("m.json").read_text())["filter"],
                         json.loads(self.file("f.json").read_text())["filter"])

    def test_a_filter_that_does_not_fit_the_options_is_refused(self):
        self.fine("train", *self.family(), "--rounds", 1, "-o", self.file("f.json"))
        self.refused(2, "--control-points 3, but the filter of", "fit", self.file("0.csv"), "--control-points", 3,
                     "--filter", self.file("f.json"), "-o", self.file("m.ifsm"))
        self.refused(3, "no.json", "fit", self.file("0.csv"), "--filter", "no.json", "-o", self.file("m.ifsm"))
        self.refused(3, "a family has one dimension", "train", self.file("0.csv"), self.file("one.csv", "1\n2\n3\n"), "-o",
                     self.file("f.json"))


class Demo(Program):
    def demo(self, *arguments):
        return subprocess.run([DEMO, *map(str, arguments)], capture_output=True, text=True)

    def test_help_is_no_fault(self):
        told = self.demo("--help")
        self.assertEqual((told.returncode, told.stderr), (0, ""))
        self.assertTrue(told.stdout.startswith("usage: ifsm-demo"))
        wrong = self.demo("one")
        self.assertEqual((wrong.returncode, wrong.stdout), (2, ""))

    def test_a_small_curve_has_fewer_budgets(self):
        source, out = self.file("small.csv", table([(x * 1e-4, y * 1e-4) for x, y in rough_ring(30)])), self.file("out")
        told = self.demo(source, out)
        self.assertEqual(told.returncode, 0, told.stderr)
        rows = [line.split() for line in (out / "errors.txt").read_text().splitlines() if len(line.split()) == 8]
        self.assertEqual([row[0] for row in rows if row[0].isdigit()], ["8", "16", "32"])
        self.assertTrue(all(float(row[2]) > 0 for row in rows if row[0] in ("8", "16")), rows)
        self.assertEqual(len(list(out.iterdir())), 7)

    def test_curves_that_cannot_be_shown_leave_no_folder(self):
        for text, words in (("0,0\n1,1\n1,0\n", "too few"), ("1,2,3\n2,3,4\n5,6,1\n", "dimension 3")):
            told = self.demo(self.file("in.csv", text), self.file("out"))
            self.assertEqual(told.returncode, 3, told.stderr)
            self.assertIn(words, told.stderr)
            self.assertEqual(self.names(), ["in.csv"])


class Signals(Program):
    def interrupted(self, number, *arguments, after, **options):
        process = subprocess.Popen([PROGRAM, *map(str, arguments)], stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                                   text=True, preexec_fn=default_signals, **options)
        time.sleep(after)
        self.assertIsNone(process.poll(), "it ended before the signal: " + str(process.returncode))
        sent = time.monotonic()
        process.send_signal(number)
        process.wait(timeout=60)  # communicate() would close its standard input, and may be faster than the signal
        seconds = time.monotonic() - sent
        _, errors = process.communicate()
        return process.returncode, seconds, errors

    def test_a_signal_in_the_middle_of_a_fit_leaves_nothing(self):
        source = self.file("in.csv", table(rough_ring(30000)))
        self.file("m.ifsm", "before")
        before = self.names()
        for number in (signal.SIGINT, signal.SIGTERM):
            code, seconds, errors = self.interrupted(number, "fit", source, "--closed", "--iterations", 1000, "--rounds",
                                                     100, "--control-points", 12, "-o", self.file("m.ifsm"), after=1.5)
            self.assertEqual(code, 130, errors)
            self.assertIn("cancelled", errors)
            self.assertLess(seconds, 2)
            self.assertEqual(self.names(), before)
            self.assertEqual(self.file("m.ifsm").read_text(), "before")

    def test_a_signal_while_waiting_for_input(self):
        code, _, errors = self.interrupted(signal.SIGINT, "fit", "-", "-o", self.file("m.ifsm"), after=0.5, stdin=subprocess.PIPE)
        self.assertEqual((code, errors), (130, "ifsm: cancelled; nothing was written.\n"))
        self.assertEqual(self.names(), [])

    def behind_a_full_pipe(self, *arguments):
        """Started with a standard output that takes nothing; and the end from which it can be emptied."""
        reader, writer = os.pipe()
        os.set_blocking(writer, False)
        try:
            while True:
                os.write(writer, b" " * 4096)
        except BlockingIOError:
            os.set_blocking(writer, True)
        process = subprocess.Popen([PROGRAM, *map(str, arguments)], stdout=writer, stderr=subprocess.PIPE, text=True,
                                   preexec_fn=default_signals)
        os.close(writer)
        self.addCleanup(process.stderr.close)
        return process, os.fdopen(reader)

    def test_a_signal_after_the_result_is_in_place_is_too_late(self):
        model, target = self.model(), self.file("keep.csv")
        for signals, code in ((1, 0), (2, 4)):
            process, pipe = self.behind_a_full_pipe("synth", model, "-o", target)
            with pipe:
                while not target.exists():
                    time.sleep(0.01)
                for _ in range(signals):
                    time.sleep(0.2)
                    self.assertIsNone(process.poll())
                    process.send_signal(signal.SIGINT)
                time.sleep(0.2)
                if code != 0:
                    process.wait(timeout=60)
                told = pipe.read().strip()
            self.assertEqual(process.wait(timeout=60), code)
            self.assertEqual(len(numbers(target.read_text())), 300)
            self.assertIn("keep.csv: 300 points" if code == 0 else "the result is written", told + process.stderr.read())
            target.unlink()

    def test_a_signal_while_a_pipe_takes_nothing(self):
        process, pipe = self.behind_a_full_pipe("synth", self.model())
        with pipe:
            time.sleep(0.5)
            process.send_signal(signal.SIGINT)
            self.assertEqual(process.wait(timeout=60), 130)
            self.assertEqual(process.stderr.read(), "ifsm: cancelled; the output got a part only.\n")


if __name__ == "__main__":
    unittest.main()
