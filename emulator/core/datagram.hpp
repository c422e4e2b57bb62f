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

/// Facts that a port knows of a datagram besides its bytes. No stage of the pipeline sees them.
struct Headers {
    /// The length of the envelope before the datagram in its bytes, such as an Ethernet header. The
    /// envelope is carried along, neither counted nor changed.
    std::uint8_t envelope_bytes = 0;
    base::IpMarks marks{};
};

/// A datagram that the link holds, or hands back to be sent.
struct Datagram {
    Slab::Slot slot = Slab::no_slot; // no_slot: the bytes are the caller's own
    bool is_copy = false;
    std::uint8_t envelope_bytes = 0; // at the beginning of `bytes`: carried, and nothing else
    base::IpMarks marks{};           // carried; the law of a queue may add CE
    std::uint64_t number = 0; // of the datagram in its direction, from 0; a copy has its original's
    base::TimePoint arrival{};
    base::TimePoint due{};              // never leaves before
    std::span<const std::byte> bytes{}; // stay where they are until it has left

    /// The size of the datagram itself, without its envelope.
    [[nodiscard]] std::size_t size() const { return bytes.size() - envelope_bytes; }
};

class Link;

/// A datagram whose time of leaving is not known yet.
struct Queued {
    Datagram datagram; // due: when its last bit left the bottleneck, or its own time without others
    Fate fate;         // dropped: it only takes time in the bottleneck, its bytes are gone
    std::size_t line_bytes = 0;         // that the bottleneck has to send
    base::TimePoint begun{};            // when it began to send it
    bool is_marked = false;             // by the law of the queue
    std::optional<DropCause> dropped{}; // by the queue, instead of being sent
    Link* owner = nullptr; // that it goes on through; null: the one whose bottleneck this is
};

} // namespace hapnet::emulator
