// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "emulator/core/fate.hpp"
#include "emulator/core/slab.hpp"
#include "proto/base/ip_marks.hpp"
#include "proto/base/time.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

namespace hapnet::emulator {

// One datagram is described by a value of its own at each stop of its way:
//
//   net::Received   proto/net       bytes, sender and receive stamp, from the socket
//   Headers         here            what its port knows of it besides
//   Packet          packet.hpp      what a stage of the pipeline may know: number, size, arrival
//   Fate            fate.hpp        what the stages have drawn for it
//   Admission       link.hpp        what the link answers on its arrival
//   Queued          here            it waits in the bottleneck or for others to overtake it
//   Datagram        here            it waits for its time in the delay line, or leaves
//   CapturedPacket  capture/        it passes a socket, as a capture file has it

/// Facts that a port knows about a datagram besides its bytes. No stage of the pipeline sees them.
struct Headers {
    /// The length of the envelope before the datagram in its bytes, such as an Ethernet header. The
    /// envelope is passed on unchanged and is not counted.
    std::uint8_t envelope_bytes = 0;
    base::IpMarks marks{};
};

/// A datagram that the link holds, or hands back to be sent.
struct Datagram {
    Slab::Slot slot = Slab::no_slot; // no_slot: the bytes are the caller's own
    bool is_copy = false;
    std::uint8_t envelope_bytes = 0; // header at the start of `bytes`: not counted, not changed
    base::IpMarks marks{};           // passed on; the law of a queue may add CE
    std::uint64_t number = 0; // counts its direction from 0; a copy has the number of its original
    base::TimePoint arrival{};
    base::TimePoint due{};              // earliest time at which it leaves
    std::span<const std::byte> bytes{}; // valid until the datagram has left

    /// The size of the datagram itself, without its envelope.
    [[nodiscard]] std::size_t size() const { return bytes.size() - envelope_bytes; }
};

class Link;

/// A datagram whose departure time is not known yet.
struct Queued {
    /// Its `due` is the time when its last bit left the bottleneck. While displaced, it is the time
    /// at which the datagram would leave on its own.
    Datagram datagram;
    // If dropped, it only takes time in the bottleneck; its bytes are gone.
    Fate fate;
    std::size_t line_bytes = 0;         // bytes that the bottleneck has to send
    base::TimePoint begun{};            // when the bottleneck began to send it
    bool is_marked = false;             // marked by the law of the queue
    std::optional<DropCause> dropped{}; // cause, if the queue dropped it instead of sending it
    Link* owner = nullptr; // link that it continues through; null: the bottleneck's owner
};

} // namespace hapnet::emulator
