# SPDX-FileCopyrightText: 2026 The Velum authors
# SPDX-License-Identifier: MIT
"""velum record: telegrams of a scripted scanner on loopback go into a file that can be replayed."""
import signal
import socket
import threading
import unittest

from support import CommandTest

ANSWERS = {
    "sMN SetAccessMode": "sAN SetAccessMode 1",
    "sMN LMCstartmeas": "sAN LMCstartmeas 0",
    "sMN Run": "sAN Run 1",
    "sRN FirmwareVersion": "sRA FirmwareVersion 5 V1.80",
    "sRN STlms": "sRA STlms 7 0",
    "sWN LMDscandatacfg": "sWA LMDscandatacfg",
    "sEN LMDscandata": "sEA LMDscandata 1",
}


def scan(number):
    """A telegram of 11 beams, 1 degree apart, at 25 Hz."""
    ranges = " ".join(f"{1000 + 10 * i:X}" for i in range(11))
    start = 1000000 + 40000 * number
    return (f"sSN LMDscandata 0 1 1145856 0 0 {number:X} {number:X} {start:X} {start + 40500:X} "
            f"0 0 3F 0 0 9C4 21C 0 1 DIST1 3F800000 00000000 DBBA0 2710 B {ranges} 0 0 0 0 0 0")


class Scanner:
    """Answers in CoLa A and streams a scan every 2 ms to each client in turn."""

    def __init__(self):
        self.listener = socket.create_server(("127.0.0.1", 0))
        self.listener.settimeout(0.05)
        self.address = f"127.0.0.1:{self.listener.getsockname()[1]}"
        self.over = False
        self.thread = threading.Thread(target=self.serve)
        self.thread.start()

    def stop(self):
        self.over = True
        self.thread.join()
        self.listener.close()  # may be called again

    def serve(self):
        while not self.over:
            try:
                client, _ = self.listener.accept()
            except socket.timeout:
                continue
            with client:
                try:
                    self.talk(client)
                except OSError:
                    pass

    def talk(self, client):
        client.settimeout(0.002)
        pending, streaming, number = b"", False, 0
        while not self.over:
            try:
                data = client.recv(4096)
                if not data:
                    return
                pending += data
            except socket.timeout:
                pass
            while b"\x03" in pending:
                frame, pending = pending.split(b"\x03", 1)
                request = frame.lstrip(b"\x02").decode()
                name = " ".join(request.split(" ")[:2])
                client.sendall(f"\x02{ANSWERS.get(name, 'sFA 3')}\x03".encode())
                if name == "sEN LMDscandata":
                    streaming = request.endswith("1")
            if streaming:
                client.sendall(f"\x02{scan(number)}\x03".encode())
                number += 1


class RecordTest(CommandTest):
    def setUp(self):
        super().setUp()
        self.needs("devices.recorder")
        self.needs("devices.replay")
        self.needs("devices.lms511")
        self.scanner = Scanner()
        self.addCleanup(self.scanner.stop)

    def keep(self, *arguments, status=0):
        """Records into a.vrec; what is said on standard output and standard error."""
        return self.velum("record", self.scanner.address, "--out", "a.vrec", "--set",
                          "encoding=cola_a", *arguments, status=status)

    def test_a_recording_is_made_looked_at_and_converted(self):
        out, _ = self.keep("--set", "lines=40")
        self.assertIn("lines          40", out)
        out, _ = self.velum("info", "a.vrec")
        self.assertIn("440 points", out)
        self.velum("convert", "a.vrec", "a.xyz")
        self.assertGreater((self.folder / "a.xyz").read_text().count("\n"), 440)

    def test_what_is_recorded_is_not_replaced_by_mistake(self):
        self.keep("--set", "lines=5")
        _, error = self.keep("--set", "lines=5", status=2)
        self.assertIn("--force", error)
        self.keep("--set", "lines=5", "--force")

    def test_ctrl_c_closes_the_recording(self):
        process = self.start("record", self.scanner.address, "--out", "a.vrec", "--set",
                             "encoding=cola_a")
        path = self.folder / "a.vrec"
        self.wait_for(lambda: path.exists() and path.stat().st_size > 500)
        process.send_signal(signal.SIGINT)
        _, error = process.communicate(timeout=60)
        self.assertEqual(process.returncode, 130, error)
        self.assertIn("a.vrec", error)
        out, _ = self.velum("info", "a.vrec")
        self.assertNotIn("not closed", out)

    def test_the_scanner_of_a_graph_is_taken_as_it_is_set(self):
        self.write("sweep.toml", f"""
            units = "m"
            [node.scan]
            use = "devices.lms511"
            address = "{self.scanner.address}"
            encoding = "cola_a"
            lines = 12
            silence_timeout = "2 s"
            """)
        out, _ = self.velum("record", "sweep.toml", "--out", "b.vrec")
        self.assertIn("lines          12", out)

    def test_a_scanner_that_is_not_there_ends_with_7(self):
        self.scanner.stop()
        _, error = self.keep("--set", "give_up=0.5 s", status=7)
        self.assertIn("given up after 0.5 s", error)

    def test_mistakes_on_the_command_line_end_with_2(self):
        self.keep("--set", "colour=red", status=2)
        self.keep("--set", "lines", status=2)
        self.keep("--set", "frequency=50", "--set", "resolution=0.25", status=2)


if __name__ == "__main__":
    unittest.main()
