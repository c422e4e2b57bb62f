# SPDX-FileCopyrightText: 2026 The Hapnet authors
# SPDX-License-Identifier: MIT
"""Messages, words and tables as Python reads and writes them.

HAPNET_REPOSITORY is the clone, whose unit tests have the same bytes."""

import json
import os
import re
import struct
import sys
import tempfile
import unittest
from pathlib import Path

from hapnet import read_csv, read_record, wire
from hapnet.emulator import address_of, key_of
from hapnet.process import option_words
from hapnet.session import Session

REPOSITORY = Path(os.environ["HAPNET_REPOSITORY"])


class Messages(unittest.TestCase):
    def test_have_the_lengths_of_the_specification(self):
        hello = wire.Hello(nonce=1, peer_id=1, task="T1", scene_hash=2)
        self.assertEqual(len(wire.encode(hello)), 117)
        state = wire.State(1, 1, 0, bodies=[wire.Body()])
        self.assertEqual(len(wire.encode(state)), 136)
        turning = wire.Body(turning=wire.Turning(0x8000008000080000))
        self.assertEqual(len(wire.encode(wire.State(1, 1, 0, bodies=[turning]))), 180)
        self.assertEqual(len(wire.encode(wire.Bye(7))), 9)

    def test_read_back_as_the_same(self):
        for message in (
            wire.Hello(nonce=5, peer_id=2, task="T10", scene_hash=1 << 63, sent=-4,
                       echo=wire.Echo(9, 8), start=7, start_heard=6, in_session=True),
            wire.State(3, 4, 5, wire.Echo(1, 2), True, True, (0.5, 0.25, -1.0), (0.0, 1.0, 2.0),
                       (3.0, 0.0, 0.0), (0.01, 0.0, -0.32767), (6.5534, 0.0, 0.0), 77,
                       [wire.Body(0), wire.Body(3, (1.0, 2.0, 4.0), caused_impulse=(1, 2, 3))]),
            wire.Bye(1, 6),
        ):  # fmt: skip
            self.assertEqual(wire.encode(wire.decode(wire.encode(message))), wire.encode(message))

    def test_refuses_what_is_not_canonical(self):
        good = wire.encode(wire.State(3, 4, 5, bodies=[wire.Body(1)]))
        wire.decode(good)
        for wrong in (
            good[:-1],
            good + b"\0",
            good[:2] + b"\1" + good[3:],  # version 1
            good[:20] + b"\x04" + good[21:],  # holding without touching
            good[:20] + b"\x08\x01" + good[22:],  # a reserved byte
            good[:34] + struct.pack("<f", float("nan")) + good[38:],
            good[:20] + b"\0" + good[21:],  # a body that is not announced
            b"",
        ):
            with self.assertRaises(wire.Malformed):
                wire.decode(wrong)

    def test_are_the_bytes_that_the_programs_write(self):
        source = (REPOSITORY / "tests/unit/proto/wire/message_format_test.cpp").read_text()
        kinds = set()
        for call in source.split("expect_bytes(")[2:]:  # the first is the function itself
            digits = "".join(re.findall(r'"([0-9a-f ]+)"', call[: call.index(");")]))
            data = bytes.fromhex(digits)
            message = wire.decode(data)
            self.assertEqual(wire.encode(message), data)
            kinds.add(type(message))
        self.assertEqual(kinds, {wire.Hello, wire.State, wire.Bye})

    def test_number_their_session_as_the_programs_do(self):
        # tests/unit/proto/wire has the same.
        self.assertEqual(wire.session_number(0x11111111, 0x22222222), 0x93eb5bd8)



class TwoSessions(unittest.TestCase):
    def test_agree_on_a_start_over_a_path_that_loses(self):
        low, high = Session(1, "T1", scene_hash=5), Session(2, "T1")
        skew, delay = 1_000_000_000_000, 20_000_000
        letters, now, sent = [], 0, 0
        for now in range(0, 3_000_000_000, 1_000_000):
            for side, other, ahead in ((low, 1, 0), (high, 0, skew)):
                hello = side.hello(now + ahead)
                sent += hello is not None
                if hello is not None and sent % 3 != 0:
                    letters.append((now + delay, other, hello))
            due = [letter for letter in letters if letter[0] <= now]
            letters = [letter for letter in letters if letter[0] > now]
            for at, to, data in due:
                (low, high)[to].hear(data, at + (skew if to else 0))
        self.assertIsNotNone(low.start)
        self.assertEqual(high.start, low.start + skew)
        self.assertEqual(low.number, high.number)
        self.assertNotEqual(low.number, 0)

    def test_keep_the_newest_state_alone(self):
        low, high = Session(1, "T1", scene_hash=5), Session(2, "T1")
        high.hear(low.hello(0), 0)
        low.hear(high.hello(0), 0)
        first, second = low.state(10), low.state(20)
        high.hear(second, 30)
        high.hear(first, 31)
        self.assertEqual(high.heard.sequence, 2)
        high.hear(low.bye(), 40)
        self.assertTrue(high.is_over)


class Words(unittest.TestCase):
    def test_of_a_command_line_follow_from_keywords(self):
        words = option_words({"delay": "5ms", "up_burst_loss": "4/9", "require": ["a>1", "b>2"],
                              "insecure": True, "profile": None})  # fmt: skip
        self.assertEqual(words, ["--delay", "5ms", "--up.burst-loss", "4/9", "--require", "a>1",
                                 "--require", "b>2", "--insecure"])  # fmt: skip
        self.assertEqual(key_of("loss"), "both.loss")
        self.assertEqual(key_of("down_burst_loss"), "down.burst_loss")
        self.assertEqual(address_of("[::1]:7001"), ("::1", 7001))


class Tables(unittest.TestCase):
    def test_have_numbers_where_there_are_numbers(self):
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "limits.csv")
            Path(path).write_text("algorithm,limit,bound,p10\nbase,160,=,\n\"a, b\",1.5,>,2\n")
            self.assertEqual(
                read_csv(path),
                [
                    {"algorithm": "base", "limit": 160, "bound": "=", "p10": None},
                    {"algorithm": "a, b", "limit": 1.5, "bound": ">", "p10": 2},
                ],
            )

    def test_of_a_record_follow_its_own_description(self):
        fields = [
            {"name": "tick", "type": "u64", "offset": 1},
            {"name": "hip", "type": "f64[3]", "offset": 9, "unit": "m"},
            {"name": "touching", "type": "bool", "offset": 33},
        ]
        message = [
            {"name": "from", "type": "u16", "offset": 1},
            {"name": "bytes", "type": "u16 n, u8[n]", "offset": 3},
        ]
        header = {
            "format": "hapnet-record", "version": 3, "row_bytes": 40, "message_row_bytes": 9,
            "byte_order": "little", "config": {"peer_id": 2},
            "schema": {"tick": {"kind": 1, "fields": fields},
                       "message": {"kind": 2, "fields": message},
                       "session": {"kind": 3, "fields": []}},
        }  # fmt: skip
        rows = b"".join(
            (
                struct.pack("<BQ3d?6x", 1, 5, 0.5, 0.25, -1.0, True),
                struct.pack("<BHH3sx", 2, 1, 3, b"abc"),
                struct.pack("<BQ3d?6x", 1, 6, 0.0, 0.0, 0.0, False)[:-1],  # cut off
            )
        )
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "a.rec")
            Path(path).write_bytes(json.dumps(header).encode() + b"\n" + rows)
            record = read_record(path)
            self.assertTrue(record.cut_off)
            self.assertEqual(record.ticks.rows, [(5, (0.5, 0.25, -1.0), True)])
            self.assertEqual(record.ticks.flat()[0]["hip_y"], 0.25)
            self.assertEqual(record.messages.column("bytes"), [b"abc"])
            Path(path).write_bytes(json.dumps(header).encode() + b"\n" + b"\0" * 40)
            with self.assertRaisesRegex(ValueError, "row 1 is damaged"):
                read_record(path)

    def test_of_a_file_that_is_no_record_are_refused(self):
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "a.rec")
            Path(path).write_text('{"format":"another"}\n')
            with self.assertRaisesRegex(ValueError, "not a record"):
                read_record(path)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
