# SPDX-FileCopyrightText: 2026 The Velum authors
# SPDX-License-Identifier: MIT
"""`velum emulate` as a client sees it that shares no line with it."""
import functools
import operator
import re
import signal
import socket
import struct
import unittest

from support import CommandTest

SCENE = """
format = 1
units = "m"
[object.wall]
shape = "plane"
label = 1
position = [0, 2, 0]
normal = [0, -1, 0]
[scanner.a]
noise = 0
tilt_from = 0
tilt_to = 10
"""


class Client:
    def __init__(self, port):
        self.socket = socket.create_connection(("127.0.0.1", port), timeout=20)
        self.left = b""

    def read(self, count):
        while len(self.left) < count:
            more = self.socket.recv(65536)
            if not more:
                raise EOFError
            self.left += more
        taken, self.left = self.left[:count], self.left[count:]
        return taken

    def close(self):
        self.socket.close()


class Ascii(Client):
    def say(self, text):
        self.socket.sendall(b"\x02" + text.encode() + b"\x03")

    def hear(self, head):
        while True:
            text = b""
            assert self.read(1) == b"\x02"
            while (byte := self.read(1)) != b"\x03":
                text += byte
            if text.decode().startswith((head, "sFA")):
                return text.decode()

    def ask(self, text, head):
        self.say(text)
        return self.hear(head)


class Binary(Client):
    def say(self, payload):
        check = functools.reduce(operator.xor, payload)
        self.socket.sendall(b"\x02" * 4 + struct.pack(">I", len(payload)) + payload +
                            bytes([check]))

    def hear(self, head):
        while True:
            assert self.read(4) == b"\x02" * 4
            payload = self.read(struct.unpack(">I", self.read(4))[0])
            assert self.read(1)[0] == functools.reduce(operator.xor, payload)
            if payload.startswith((head, b"sFA")):
                return payload

    def ask(self, payload, head):
        self.say(payload)
        return self.hear(head)


def binary_scan(payload):
    """Counter, start time, start angle, step, ranges of an LMDscandata without encoder."""
    body = payload[len(b"sSN LMDscandata "):]
    telegram, scan, start = struct.unpack(">HHI", body[10:18])
    encoders, channels = struct.unpack(">HH", body[36:40])
    assert (encoders, channels, body[40:45]) == (0, 1, b"DIST1")
    angle, step, count = struct.unpack(">iHH", body[53:61])
    ranges = struct.unpack(f">{count}H", body[61:61 + 2 * count])
    return telegram, scan, start, angle, step, ranges


class EmulateTest(CommandTest):
    def setUp(self):
        super().setUp()
        self.needs("devices.emulator")
        self.write("scene.toml", SCENE)

    def emulate(self, *arguments):
        """The process and its two ports."""
        process = self.start("emulate", "scene.toml", "--port", "0", *arguments)
        self.addCleanup(self.end, process)
        line = process.stdout.readline()
        found = re.search(r"^listening .*port (\d+) \(CoLa A\), port (\d+) ", line)
        self.assertTrue(found, line or process.stderr.read())
        return process, int(found[1]), int(found[2])

    @staticmethod
    def end(process):
        if process.returncode is None:
            process.kill()
            process.communicate()

    def call(self, kind, port):
        client = kind(port)
        self.addCleanup(client.close)
        return client

    def stop(self, process, sign=signal.SIGINT):
        process.send_signal(sign)
        _, error = process.communicate(timeout=30)
        self.assertEqual(process.returncode, 130, error)
        self.assertEqual(error, "")

    def test_a_client_of_cola_a(self):
        process, port, _ = self.emulate("--speed", "0", "--resolution", "0.5", "--frequency", "50")
        client = self.call(Ascii, port)
        self.assertEqual(client.ask("sMN SetAccessMode 03 F4724744", "sAN"), "sAN SetAccessMode 1")
        self.assertEqual(client.ask("sRN LMPscancfg", "sRA"),
                         "sRA LMPscancfg 1388 1 1388 FFFF3CB0 1C3A90")
        self.assertEqual(client.ask("sRN nothing", "sRA"), "sFA 3")
        self.assertEqual(client.ask("sMN LMCstartmeas", "sAN"), "sAN LMCstartmeas 0")
        self.assertEqual(client.ask("sMN Run", "sAN"), "sAN Run 1")
        self.assertEqual(client.ask("sEN LMDscandata 1", "sEA"), "sEA LMDscandata 1")
        tokens = client.hear("sSN LMDscandata").split(" ")
        at = tokens.index("DIST1")
        self.assertEqual(tokens[at + 1:at + 6], ["3F800000", "00000000", "FFFF3CB0", "1388", "17D"])
        self.assertEqual(int(tokens[at + 6 + 190], 16), 2000)
        self.stop(process)

    def test_a_client_of_cola_b(self):
        process, _, port = self.emulate("--speed", "0", "--resolution", "0.1667", "--frequency", "100")
        client = self.call(Binary, port)
        self.assertEqual(client.ask(b"sEN LMDscandata \x01", b"sEA"), b"sEA LMDscandata \x01")
        scans = [binary_scan(client.hear(b"sSN LMDscandata")) for _ in range(9)]
        self.assertEqual({s[3] for s in scans}, {-50000, -46666, -48333, -44999})
        for before, after in zip(scans, scans[1:]):
            self.assertEqual(after[0], before[0] + 1)
            self.assertEqual(after[1], before[1] + 1)
            self.assertEqual(after[2], before[2] + 10000)
        self.assertEqual({s[4] for s in scans}, {6667})
        self.stop(process, signal.SIGTERM)

    def test_a_fault_on_request(self):
        process, port, _ = self.emulate("--fault", "error", "--set", "fault_code=13")
        self.assertEqual(self.call(Ascii, port).ask("sRN DeviceIdent", "sRA"), "sFA D")
        self.stop(process)

    def test_what_cannot_be(self):
        process, port, _ = self.emulate()
        _, error = self.velum("emulate", "scene.toml", "--port", port, status=7)
        self.assertIn("cannot listen on 127.0.0.1 port", error)
        self.stop(process)
        _, error = self.velum("emulate", "scene.toml", "--scanner", "b", status=2)
        self.assertIn("known: a", error)
        _, error = self.velum("emulate", "scene.toml", "--frequency", "60", status=2)
        self.assertIn("cannot turn at 60 Hz", error)
        _, error = self.velum("emulate", "scene.toml", "--fault", "sulking", status=2)
        _, error = self.velum("emulate", "scene.toml", "--set", "sulking", status=2)
        self.velum("emulate", "nothing.toml", status=5)


if __name__ == "__main__":
    unittest.main()
