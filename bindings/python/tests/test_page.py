import importlib.util
import os
import re
import tempfile
import unittest
from pathlib import Path

import stillbeam as sb

PAGE = Path(__file__).parents[3] / "docs" / "python.md"
BENCHMARKS = Path(__file__).parents[1] / "benchmarks"


def rows(head):
    """Return the cells of the page's table with that head, row by row."""
    text = PAGE.read_text(encoding="utf-8")
    _, table = text.split(head + "\n", 1)
    lines = table.split("\n\n", 1)[0].splitlines()[1:]
    return [[cell.strip() for cell in line.strip("|").split("|")] for line in lines]


class Page(unittest.TestCase):
    def test_the_programs_of_the_page_run_one_after_the_other(self):
        programs = re.findall(r"```python\n(.*?)```", PAGE.read_text(encoding="utf-8"), re.DOTALL)
        self.assertGreaterEqual(len(programs), 4)
        names = {}
        before = os.getcwd()
        with tempfile.TemporaryDirectory() as folder:
            os.chdir(folder)
            try:
                for program in programs:
                    exec(compile(program, str(PAGE), "exec"), names)
                self.assertEqual(sorted(os.listdir()), ["plan.png", "setpoints.csv"])
            finally:
                os.chdir(before)
        self.assertLess(names["plan"].residual, 1e-3)
        self.assertTrue(names["generator"].time > 1.0 and names["rests"], names["facts"])

    def test_the_calls_of_the_page_are_there(self):
        calls = [call for call, _ in rows("| call | returns |")]
        names = [name for call in calls for name in re.findall(r"`([A-Za-z.]+)(?:\.[a-z_]+)?\(", call)]
        self.assertGreaterEqual(len(names), 11)
        for name in names:
            self.assertTrue(hasattr(sb, name.split(".")[0]), name)

    def test_the_table_beside_exudyn_is_that_of_its_script(self):
        # Times are the machine's, and Exudyn's own errors need Exudyn.
        place = BENCHMARKS / "exudyn_swing.py"
        spec = importlib.util.spec_from_file_location("exudyn_swing", place)
        script = importlib.util.module_from_spec(spec)
        spec.loader.exec_module(script)
        wanted = script.judge()
        table = rows("| model | lines | ms | tip error, % of L |")
        self.assertEqual(len(table), 6)
        for model, lines, _, error in table:
            own = model.startswith("stillbeam")
            work = script.with_stillbeam if own else script.with_exudyn
            self.assertEqual(int(lines), script.lines(work), model)
            if own:
                tick = 1e-3 * float(re.search(r"([0-9.]+) ms$", model).group(1))
                found = script.error(script.with_stillbeam(tick), wanted)
                self.assertEqual(error, f"{found:.4f}", model)


if __name__ == "__main__":
    unittest.main()
