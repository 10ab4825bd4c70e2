import tempfile
import unittest
from pathlib import Path

import numpy as np

import stillbeam as sb


class Exports(unittest.TestCase):
    def test_words_bytes_and_sources_agree(self):
        scene = sb.Scene.from_toml("d-tip30-quick")
        arm = sb.export(scene, method="elastica", payloads=[0.02, 0.03], still=True)
        self.assertEqual(arm.stepper, "Elastica<f32, 2>")
        np.testing.assert_array_equal(arm.payloads, [0.02, 0.03])
        words = [np.concatenate(pair) for pair in zip(arm.arms, arm.planners)]
        self.assertEqual(arm.to_bytes(), np.concatenate(words).astype("<u4").tobytes())
        self.assertFalse((words[0] == words[1]).all())
        for text in (arm.to_rust(), arm.to_c()):
            self.assertIn(f"{arm.arms[0][3]:#010x}", text)
        with tempfile.TemporaryDirectory() as folder:
            for name, content in (("arm.rs", arm.to_rust()), ("arm.h", arm.to_c())):
                path = Path(folder) / name
                arm.write(path)
                self.assertEqual(path.read_text(encoding="utf-8"), content)
            arm.write(Path(folder) / "arm.bin")
            self.assertEqual((Path(folder) / "arm.bin").read_bytes(), arm.to_bytes())

    def test_refusals(self):
        scene = sb.Scene.from_toml("d-tip30-quick")
        with self.assertRaisesRegex(ValueError, "payload"):
            sb.export(scene, method="elastica", payloads=[-1.0])


if __name__ == "__main__":
    unittest.main()
