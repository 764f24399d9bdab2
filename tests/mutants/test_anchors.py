# SPDX-License-Identifier: GPL-2.0-or-later
"""Every fault of the list still applies to the tree, and the list is as long as promised."""

import unittest

import fault_list


class Anchors(unittest.TestCase):
    def setUp(self):
        self.faults = fault_list.read_all()

    def test_every_fault_applies(self):
        wrong = []
        for fault in self.faults:
            try:
                fault.applied((fault_list.ROOT / fault.file).read_text())
            except (fault_list.ListError, OSError) as error:
                wrong.append(str(error))
        self.assertFalse(wrong, "\n" + "\n".join(wrong))

    def test_no_fault_stands_twice(self):
        seen = {}
        for fault in self.faults:
            changed = fault.applied((fault_list.ROOT / fault.file).read_text())
            self.assertEqual(seen.setdefault((fault.file, changed), fault).where(), fault.where())

    def test_few_are_equivalent(self):
        equivalent = [fault.name for fault in self.faults if fault.equivalent]
        self.assertLessEqual(len(equivalent), 0.05 * len(self.faults), equivalent)

    def test_a_fault_changes_one_line(self):
        for fault in self.faults:
            self.assertLessEqual(fault.find.count("\n"), 2, fault.where())


class Place(unittest.TestCase):
    def fault(self, **changed):
        entry = {"name": "n", "file": "f.cpp", "find": "a < b", "replace": "a <= b", "breaks": "x", "tests": ("t",),
                 "targets": ("t",), "listed_in": "f.yaml", **changed}
        return fault_list.Fault(**entry)

    def test_the_anchor_stands_once(self):
        self.assertEqual(self.fault().applied("if (a < b) c;"), "if (a <= b) c;")
        for source in ("if (a > b) c;", "a < b; a < b;"):
            with self.assertRaisesRegex(fault_list.ListError, "adapt the entry n in tests/mutants/f.yaml or delete it"):
                self.fault().applied(source)

    def test_one_of_several(self):
        self.assertEqual(self.fault(occurrence=2).applied("a < b; a < b;"), "a < b; a <= b;")
        with self.assertRaises(fault_list.ListError):
            self.fault(occurrence=3).applied("a < b; a < b;")


if __name__ == "__main__":
    unittest.main()
