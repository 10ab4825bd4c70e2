import os
import re
import tempfile
import unittest
from pathlib import Path

PAGE = Path(__file__).parents[3] / "docs" / "python.md"


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


if __name__ == "__main__":
    unittest.main()
