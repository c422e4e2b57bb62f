# SPDX-FileCopyrightText: 2026 The Hapnet authors
# SPDX-License-Identifier: MIT
"""Sends frames of every kind from one interface and compares what another one receives, byte for
byte and in order, and the other way round.
Usage: frames.py INTERFACE_A INTERFACE_B
Prints how many of them had an IP packet, each way."""
import random
import select
import socket
import struct
import sys

ETH_P_ALL = 3
SOL_PACKET = 263
PACKET_AUXDATA = 8
PACKET_IGNORE_OUTGOING = 23
VLAN_VALID = 1 << 4
VLAN_TPID_VALID = 1 << 6
A = bytes.fromhex("02000000000a")
B = bytes.fromhex("02000000000b")
draw = random.Random(1)


def checksum(data):
    total = sum(struct.unpack(f"!{(len(data) + 1) // 2}H", data + bytes(len(data) % 2)))
    while total > 0xFFFF:
        total = (total & 0xFFFF) + (total >> 16)
    return struct.pack("!H", ~total & 0xFFFF)


def ipv4(payload, protocol=17, tos=0, ttl=64, fragment=0, options=b""):
    """From 10.0.0.1 to 10.0.0.2."""
    first = 0x40 | (5 + len(options) // 4)
    length = 20 + len(options) + len(payload)
    head = struct.pack("!BBHHHBB", first, tos, length, 7, fragment, ttl, protocol)
    ends = bytes((10, 0, 0, 1, 10, 0, 0, 2)) + options
    return head + checksum(head + bytes(2) + ends) + ends + payload


def ipv6(payload, next_header=17, traffic_class=0, hops=64):
    """From fd00::1 to fd00::2."""
    head = struct.pack("!IHBB", 6 << 28 | traffic_class << 20 | 0xABCDE, len(payload), next_header,
                       hops)
    return head + b"\xfd" + bytes(14) + b"\x01" + b"\xfd" + bytes(14) + b"\x02" + payload


def udp(size):
    """Its checksum is wrong: a wire does not care."""
    return struct.pack("!HHHH", 7000, 7001, 8 + size, 0xBAD0) + draw.randbytes(size)


def tag(vlan, protocol=0x8100, priority=0, may_be_dropped=0):
    return struct.pack("!HH", protocol, priority << 13 | may_be_dropped << 12 | vlan)


def payloads():
    """Pairs: what follows the addresses, whether the emulator takes it for an IP packet."""
    v4, v6, arp = b"\x08\x00", b"\x86\xdd", b"\x08\x06"
    inside = [
        (v4 + ipv4(udp(100)), True),
        (v4 + ipv4(udp(1472)), True),  # 1500 bytes
        (v4 + ipv4(udp(0), tos=0xFF, ttl=1, fragment=0x4000), True),
        (v4 + ipv4(udp(33), options=bytes((7, 3, 4, 0))), True),
        (v4 + ipv4(draw.randbytes(64), fragment=0x2000 | 185), True),
        (v4 + ipv4(draw.randbytes(40), protocol=6), True),
        (v4 + ipv4(b"\x08\x00" + draw.randbytes(62), protocol=1), True),
        (v4 + ipv4(draw.randbytes(50), protocol=132), True),
        (v4 + ipv4(udp(100))[:-30], True),  # cut off
        (v4 + ipv4(udp(10)) + draw.randbytes(8), True),  # padding behind it
        (v6 + ipv6(udp(100), traffic_class=0xB9, hops=1), True),
        (v6 + ipv6(udp(1452)), True),
        (v6 + ipv6(b"\x11\x00" + bytes(6) + udp(20), next_header=0), True),  # hop by hop
        (v6 + ipv6(b"\x80\x00" + draw.randbytes(60), next_header=58), True),  # an echo
        (v6 + ipv6(b"\x87\x00" + draw.randbytes(30), next_header=58, hops=255), False),  # who has
        (arp + struct.pack("!HHBBH", 1, 0x800, 6, 4, 1) + draw.randbytes(20), False),
        (arp + struct.pack("!HHBBH", 1, 0x800, 6, 4, 2) + draw.randbytes(38), False),
    ]
    yield from inside
    for body, is_ip in inside:
        yield tag(7) + body, is_ip
        yield tag(4094, priority=7, may_be_dropped=1) + body, is_ip
        yield tag(0, priority=5) + body, is_ip  # a priority alone
    small = [(body, is_ip) for body, is_ip in inside if len(body) < 1000]
    for body, is_ip in small:
        yield tag(100, 0x88A8) + tag(7, priority=3) + body, is_ip
        yield tag(100) + tag(7) + body, is_ip
        yield tag(1, 0x88A8) + tag(2) + tag(3) + body, False
    yield b"\x88\xcc" + draw.randbytes(60), False  # LLDP
    yield b"\x00\x40" + draw.randbytes(64), False  # 802.3 with a length
    yield b"\x88\xf7" + draw.randbytes(44), False  # PTP
    for length in (0, 1, 2, 3, 7, 45, 46, 1499, 1500):
        yield b"\x88\xb5" + draw.randbytes(length), False  # for experiments
        yield b"\x08\x00" + draw.randbytes(length), True  # not IP at all


def open_on(interface):
    end = socket.socket(socket.AF_PACKET, socket.SOCK_RAW, socket.htons(ETH_P_ALL))
    end.setsockopt(SOL_PACKET, PACKET_AUXDATA, 1)
    end.setsockopt(SOL_PACKET, PACKET_IGNORE_OUTGOING, 1)
    end.bind((interface, ETH_P_ALL))
    return end


def receive(end):
    """A frame as it was on the wire: the kernel hands its first tag over apart."""
    data, labels, _, _ = end.recvmsg(65536, 256)
    for level, kind, label in labels:
        if level != SOL_PACKET or kind != PACKET_AUXDATA:
            continue
        status, _, _, _, _, tci, protocol = struct.unpack("IIIHHHH", label[:20])
        if status & VLAN_VALID:
            protocol = protocol if status & VLAN_TPID_VALID else 0x8100
            data = data[:12] + struct.pack("!HH", protocol, tci) + data[12:]
    return data


def compare(sender, receiver, ends):
    """Sends each payload and expects it at once on the other side; gives how many were IP."""
    to, source = ends
    count = 0
    for body, is_ip in payloads():
        target = b"\xff" * 6 if body[:2] == b"\x08\x06" else to
        if body[:2] == b"\x88\xcc":
            target = bytes.fromhex("0180c200000e")
        sent = target + source + body
        sender.send(sent)
        got = b""
        while got[6:12] != source:  # kernels speak of themselves, too
            if not select.select([receiver], [], [], 5)[0]:
                sys.exit(f"FAILED: {len(sent)} bytes did not arrive: {sent[:60].hex()}")
            got = receive(receiver)
        if got != sent:
            sys.exit(f"FAILED: sent     {sent.hex()}\n        received {got.hex()}")
        count += is_ip
    return count


def main():
    a, b = (open_on(name) for name in sys.argv[1:3])
    print(compare(a, b, (B, A)), compare(b, a, (A, B)))


main()
