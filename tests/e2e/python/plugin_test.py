# SPDX-FileCopyrightText: 2026 The Hapnet authors
# SPDX-License-Identifier: MIT
"""The fixtures of pytest, and records and results in numpy and pandas. Run by pytest, as its users
run it: `python3 -m pytest -p hapnet.pytest_plugin plugin_test.py`."""

import socket

import pytest

from hapnet import read_record, to_frame


def free_port():
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as one:
        one.bind(("127.0.0.1", 0))
        return one.getsockname()[1]


@pytest.fixture
def client():
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as one:
        one.bind(("127.0.0.1", 0))
        one.settimeout(10.0)
        yield one


def test_an_emulator_passes_what_a_client_sends(hapnet_emulator, client):
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as server:
        server.bind(("127.0.0.1", 0))
        server.settimeout(10.0)
        network = hapnet_emulator(upstream="%s:%d" % server.getsockname(), delay="2ms")
        client.sendto(b"there", network.address)
        data, sender = server.recvfrom(100)
        server.sendto(data + b" and back", sender)
        assert client.recv(100) == b"there and back"
        assert network.stats()["up"]["received"] == 1


@pytest.fixture(scope="module")
def left():
    return []


def test_an_emulator_runs_during_its_test(hapnet_emulator, left):
    left.append(hapnet_emulator())
    assert left[0].is_running()


def test_the_emulator_of_the_test_before_has_ended(left):
    assert not left[0].is_running()


def turning_cube(hapnet_peer, folder):
    """Two hands turn a cube for a moment: the peers' records."""
    records = [str(folder / name) for name in ("a.rec", "b.rec")]
    ports = [free_port(), free_port()]
    peers = [
        hapnet_peer(id=number + 1, listen=f"127.0.0.1:{ports[number]}", task="T8",
                    remote=f"127.0.0.1:{ports[1 - number]}", duration="4s",
                    record=records[number])
        for number in (0, 1)
    ]  # fmt: skip
    for peer in peers:
        peer.join(40.0)
    return records


def test_records_of_a_body_that_turns_come_into_numpy_and_pandas(hapnet_peer, hapnet_lab, tmp_path):
    numpy = pytest.importorskip("numpy")
    pytest.importorskip("pandas")
    records = turning_cube(hapnet_peer, tmp_path)
    record = read_record(records[0])
    hips = record.ticks.to_numpy("hip")
    assert hips.shape == (len(record.ticks), 3)
    assert numpy.ptp(hips[:, 0]) > 0.001
    frame = record.ticks.to_frame()
    assert len(frame) == len(record.ticks)
    assert numpy.array_equal(frame["hip_x"].to_numpy(), hips[:, 0])
    turned = record.bodies.to_numpy("orientation")
    assert turned.shape[1] == 4
    assert numpy.allclose(numpy.linalg.norm(turned, axis=1), 1.0)
    assert set(record.bodies.column("owner")) <= {0, 1, 2}

    analysis = hapnet_lab.analyse(*records)
    assert analysis["discrepancy_x_mm"]["mean"] >= 0.0


def test_rows_of_results_come_into_pandas(hapnet_lab, tmp_path):
    pytest.importorskip("pandas")
    experiment = tmp_path / "small.toml"
    experiment.write_text('title = "small"\nkind = "table1"\nseeds = 1\nduration = "6s"\n'
                          'algorithms = ["base"]\ntasks = ["T1"]\n[both]\ndelay = "40ms"\n')
    done = hapnet_lab.run(str(experiment), str(tmp_path / "out"))
    frame = to_frame(done.rows("sessions.csv"))
    assert list(frame["algorithm"].unique()) == ["base"]
    assert len(frame) >= 1
