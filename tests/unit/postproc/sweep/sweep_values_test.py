# SPDX-License-Identifier: GPL-2.0-or-later
"""Values of --sweep: ranges, lists, what is refused; names of folders; seeds."""

import unittest

from furrow_post.errors import ResultsError
from furrow_post.sweep.sampling import sampled
from furrow_post.sweep.sweep_values import (
    Variable,
    folder_name,
    further_seeds,
    parse_variable,
    parse_variables,
    product,
)

# text, values
RIGHT = (
    ("slip=-0.3:0.6:10", "-0.3 -0.2 -0.1 0 0.1 0.2 0.3 0.4 0.5 0.6"),
    ("load=100:300:3", "100 200 300"),
    ("load=300:100:2", "300 100"),
    ("speed=1e-3:2e-3:3", "0.001 0.0015 0.002"),
    ("load=100, 250 ,300", "100 250 300"),
    ("load=200", "200"),
    ("material=a.yaml,b.yaml", "a.yaml b.yaml"),
    ("material=crust.yaml:0.03,snow.yaml", "crust.yaml:0.03 snow.yaml"),
    ("material=crust.yaml:0.03", "crust.yaml:0.03"),
)
# text, error
WRONG = (
    ("slip", "'slip' has no ="),
    ("=1,2", "'=1,2' has no name"),
    ("slip=", "slip has no values"),
    ("slip=1,,2", "has an empty value"),
    ("slip=,", "has an empty value"),
    ("slip=1,2,1", "slip has 1 twice"),
    ("slip=0:1", "'0:1' is no range FIRST:LAST:COUNT"),
    ("slip=0:1:2:3", "is no range"),
    ("slip=0:x:3", "is no range"),
    ("slip=0:inf:3", "is no range"),
    ("slip=0:1:0.1", "0.1 is no number of points, which are at least 2; FIRST:LAST:COUNT has the"),
    ("slip=0:1:1", "1 is no number of points"),
    ("slip=0:1:-4", "-4 is no number of points"),
    ("slip=1:1:3", "begins and ends at 1"),
    ("slip=0:1:100000", "at most 10000"),
)


class ValuesTest(unittest.TestCase):
    def test_values_are_expanded(self) -> None:
        for text, values in RIGHT:
            with self.subTest(text):
                self.assertEqual(" ".join(parse_variable(text).values), values)

    def test_faults_are_refused(self) -> None:
        for text, message in WRONG:
            with self.subTest(text), self.assertRaises(ResultsError) as refused:
                parse_variable(text)
            self.assertIn(message, str(refused.exception))

    def test_several_variables_multiply(self) -> None:
        points = product(parse_variables(["slip=0,0.1", "load=100,200"]))
        self.assertEqual(len(points), 4)
        self.assertEqual(points[1], {"slip": "0", "load": "200"})
        with self.assertRaisesRegex(ResultsError, "slip is given 2 times"):
            parse_variables(["slip=0,1", "slip=2"])
        with self.assertRaisesRegex(ResultsError, "asks for 1000000 points"):
            parse_variables(["a=1:1000:1000", "b=1:1000:1000"])

    def test_folder_names_are_valid_and_unique(self) -> None:
        self.assertEqual(folder_name({"slip": "-0.1", "load": "2e3"}), "slip_-0.1_load_2e3")
        strange = ("mode towed", "mode/towed", "../a.yaml", "a.yaml", "..", "x" * 300 + "/")
        names = [folder_name({"v": value}) for value in strange]
        self.assertEqual(len(set(names)), len(names))
        for name in names:
            self.assertRegex(name, r"^v_[A-Za-z0-9.+-]{1,60}$")

    def test_seeds_are_successive_primes(self) -> None:
        self.assertEqual(further_seeds(10000, 3), [10007, 10009, 10037])
        self.assertEqual(further_seeds(10007, 1), [10009])

    def test_variable_keeps_its_texts(self) -> None:
        self.assertEqual(
            parse_variable("motion=mode towed,mode slip slip 0"),
            Variable("motion", ("mode towed", "mode slip slip 0")),
        )

    def test_samples_fill_the_box_and_extend_smaller_samples(self) -> None:
        words = ("slip=-0.2:0.6", "load=300:900")
        points = sampled(words, 60)
        self.assertEqual(sampled(words, 20), points[:20])
        for name, low, high in (("slip", -0.2, 0.6), ("load", 300.0, 900.0)):
            values = sorted(float(point[name]) for point in points)
            self.assertTrue(low <= values[0] and values[-1] <= high)
            gaps = [b - a for a, b in zip([low, *values], [*values, high])]
            self.assertLess(max(gaps), 0.06 * (high - low))  # without holes along any variable
        for text, message in (
            ("slip=0:1:3", "no range of two numbers"),
            ("slip=a:b", "no range"),
            ("slip=1:1", "no range"),
        ):
            with self.assertRaisesRegex(ResultsError, message):
                sampled([text], 5)
        with self.assertRaisesRegex(ResultsError, "slip is given 2 times"):
            sampled(["slip=0:1", "slip=0:2"], 5)


if __name__ == "__main__":
    unittest.main()
