#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 The Hapnet authors
# SPDX-License-Identifier: MIT
"""Our handshake against dissononce, an implementation of Noise by other people, in both roles.

interoperation_test.py NOISE_SIDE: prints what was done; exit code 1 for a difference, 77 when
dissononce is not installed.
"""

import os
import subprocess
import sys

try:
    from dissononce.cipher.chachapoly import ChaChaPolyCipher
    from dissononce.dh.x25519.private import PrivateKey
    from dissononce.dh.x25519.public import PublicKey
    from dissononce.dh.x25519.x25519 import X25519DH
    from dissononce.hash.blake2b import Blake2bHash
    from dissononce.processing.handshakepatterns.interactive.KK import KKHandshakePattern
    from dissononce.processing.impl.cipherstate import CipherState
    from dissononce.processing.impl.handshakestate import HandshakeState
    from dissononce.processing.impl.symmetricstate import SymmetricState
    from dissononce.processing.modifiers.psk import PSKPatternModifier
except ImportError as missing:
    print(f"skipped: {missing} (Debian: python3-dissononce python3-transitions)")
    sys.exit(77)

CURVE = X25519DH()
MESSAGES = 100


class OurSide:
    def __init__(self, program):
        self.process = subprocess.Popen(
            [program], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True
        )

    def ask(self, verb, *values):
        words = [v if isinstance(v, str) else v.hex() or "-" for v in values]
        self.process.stdin.write(" ".join([verb, *words]) + "\n")
        self.process.stdin.flush()
        answer = self.process.stdout.readline().strip()
        if answer in ("ok", "refused", ""):
            return answer
        return b"" if answer == "-" else bytes.fromhex(answer)


def key_pair(secret):
    return CURVE.generate_keypair(PrivateKey(secret))


def handshake(program, we_initiate):
    ours, theirs = key_pair(os.urandom(32)), key_pair(os.urandom(32))
    shared, prologue = os.urandom(32), os.urandom(18)

    other = HandshakeState(
        SymmetricState(CipherState(ChaChaPolyCipher()), Blake2bHash()), CURVE
    )
    other.initialize(
        PSKPatternModifier(0).modify(KKHandshakePattern()),
        not we_initiate,
        prologue,
        s=theirs,
        rs=PublicKey(ours.public.data),
        psks=(shared,),
    )
    assert other.protocol_name == "Noise_KKpsk0_25519_ChaChaPoly_BLAKE2b", other.protocol_name

    us = OurSide(program)
    role = "initiator" if we_initiate else "responder"
    began = us.ask(
        "begin", role, ours.private.data, theirs.public.data, shared, prologue, os.urandom(32)
    )
    assert began == "ok", began

    first, second = os.urandom(16), os.urandom(4)
    buffer = bytearray()
    if we_initiate:
        other.read_message(us.ask("write", first), buffer)
        assert buffer == first, "the first payload differs"
        buffer = bytearray()
        ciphers = other.write_message(second, buffer)
        assert us.ask("read", bytes(buffer)) == second, "the second payload differs"
        receiving, sending = ciphers  # of the initiator; the other one is the responder
    else:
        other.write_message(first, buffer)
        assert us.ask("read", bytes(buffer)) == first, "the first payload differs"
        buffer = bytearray()
        ciphers = other.read_message(us.ask("write", second), buffer)
        assert buffer == second, "the second payload differs"
        sending, receiving = ciphers
    assert us.ask("split") == other.symmetricstate.get_handshake_hash(), "the hashes differ"
    for i in range(MESSAGES):
        text = os.urandom(i)
        assert us.ask("open", sending.encrypt_with_ad(b"", text)) == text, f"message {i}"
        assert receiving.decrypt_with_ad(b"", us.ask("seal", text)) == text, f"message {i}"
    us.process.stdin.close()
    assert us.process.wait() == 0


def main():
    for we_initiate in (True, False):
        for _ in range(5):
            handshake(sys.argv[1], we_initiate)
        print(f"as {'initiator' if we_initiate else 'responder'}: 5 handshakes, "
              f"{MESSAGES} messages each way")


main()
