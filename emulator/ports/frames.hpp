// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "emulator/core/frame.hpp"
#include "emulator/core/paths.hpp"
#include "emulator/recorder.hpp"
#include "proto/base/time.hpp"
#include "proto/net/packet_socket.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>

namespace hapnet::emulator::ports {

/// Two network interfaces and the path between them, as a bridge that impairs. The datagrams of the
/// path are IP packets; their Ethernet headers go with them. ARP and neighbour discovery pass
/// undisturbed. Moves frames; EmulatedPath takes every decision.
class Frames {
public:
    struct Setup {
        std::string interface_a;
        std::string interface_b;
        bool all_frames = false;      // the conditions hold for every frame
        bool fix_checksums = false;   // of what leaves: damage is then not found by them
        bool stops_at_loop = false;   // when one machine is heard on both sides
        bool answers_too_big = false; // tells the sender of what `mtu` drops, as a router would
        /// Why a packet may be longer than the MTU, and what a person can do; "": the interface
        /// puts segments together.
        std::string cure_of_oversized{};
    };

    /// One interface, and the direction that begins there.
    struct Side {
        Side(Direction from_here, const std::string& name);

        Direction direction;
        std::string interface;
        net::PacketSocket socket;
        std::size_t frame_bytes_max;   // of its MTU
        std::uint64_t undisturbed = 0; // frames that the conditions do not hold for
        std::uint64_t not_ip = 0;
        std::uint64_t oversized = 0;        // longer than the MTU: put together by an interface
        std::uint64_t lost_undisturbed = 0; // of `undisturbed`: the system did not take them
        std::uint64_t told_too_big = 0;     // of its packets: those whose sender got an answer
        std::uint64_t unreachable = 0;      // its answers that no program listens there
    };

    /// Adds the only path. Throws std::system_error when an interface cannot be used. The paths and
    /// the recorder outlive it.
    Frames(const Setup& setup, Paths& paths, Recorder& recorder);

    /// Takes what has arrived, at most one batch a side, and sends on at once what is not delayed.
    void receive();

    /// Sends what is due at `now`; what is left is still due.
    void release(base::TimePoint now);

    /// Something that a person should be told of, once.
    [[nodiscard]] std::optional<std::string> next_notice();

    /// Why it must not go on; nullopt: it may.
    [[nodiscard]] const std::optional<std::string>& failure() const { return failure_; }

    /// From now on an interface that goes is no failure: what stands behind it ends.
    void expect_end() { is_end_expected_ = true; }

    [[nodiscard]] const EmulatedPath& path() const { return path_; }
    [[nodiscard]] const Side& a() const { return a_; }
    [[nodiscard]] const Side& b() const { return b_; }

private:
    /// What leaves on one side, gathered and sent together.
    class Outgoing;

    void pass(Side& from, Side& to);
    void watch_interface(const Side& side);
    void release(EmulatedPath& path, base::TimePoint now);
    bool send_due(EmulatedPath& path, Direction direction, base::TimePoint now);
    void watch_for_loop(const Side& from, const Frame& frame);
    void answer_too_big(Side& from, const EmulatedPath& path, std::span<const std::byte> frame);

    Setup setup_;
    Paths& paths_;
    EmulatedPath& path_;
    Recorder::Lane& recorder_;
    std::uint32_t recorded_as_;
    Side a_;
    Side b_;
    /// The machines heard last, by a hash of their addresses, and where: enough to find a loop,
    /// which repeats them all the time.
    struct Heard {
        MacAddress who{};
        Direction direction = Direction::up;
        base::TimePoint at{};
        unsigned moves = 0;
    };
    std::array<Heard, 1024> heard_{};
    base::TimePoint arrival_{};
    std::optional<std::string> failure_;
    std::optional<std::string> untold_;
    bool has_told_of_oversized_ = false;
    bool is_end_expected_ = false;
};

} // namespace hapnet::emulator::ports
