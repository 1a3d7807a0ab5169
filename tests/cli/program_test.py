"""The ifsm program from outside: python3 program_test.py PROGRAM"""
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

PROGRAM = os.path.abspath(sys.argv.pop(1)) if len(sys.argv) > 1 else "ifsm"


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


class Reports(Program):
    def test_info_adds_up(self):
        info = json.loads(self.fine("info", self.model(), "--json"))
        self.assertEqual((info["samples"], info["dimension"], info["closed"]), (300, 2, True))
        self.assertEqual(sum(level["details"] for level in info["energy_by_level"]), info["details"])
        self.assertEqual(sum(level["kept"] for level in info["energy_by_level"]), info["details_kept"])
        self.assertIn("condition", self.fine("info", self.model()))

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
        for command in ("fit", "info", "synth", "eval"):
            self.assertIn("Examples", self.fine(command, "--help"))


class Misuse(Program):
    def test_usage(self):
        source, target, model = self.file("in.csv", "x,y\n0,0\n1,1\n2,0\n"), self.file("m.ifsm"), self.model()
        fit = ("fit", source, "-o", target)
        self.refused(2, "subcommand")
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
        self.refused(4, "is a directory", "fit", source, "--no-fit", "-q", "-o", self.folder)
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


class Signals(Program):
    def interrupted(self, number, *arguments, after, **options):
        process = subprocess.Popen([PROGRAM, *map(str, arguments)], stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                                   text=True, preexec_fn=default_signals, **options)
        time.sleep(after)
        self.assertIsNone(process.poll(), "it ended before the signal: " + str(process.returncode))
        sent = time.monotonic()
        process.send_signal(number)
        process.wait(timeout=60)  # its input stays open: the end of that would race with the signal
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
        code, _, _ = self.interrupted(signal.SIGINT, "fit", "-", "-o", self.file("m.ifsm"), after=0.5, stdin=subprocess.PIPE)
        self.assertEqual(code, 130)
        self.assertEqual(self.names(), [])


if __name__ == "__main__":
    unittest.main()
