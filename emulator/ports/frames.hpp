// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "emulator/core/frame.hpp"
#include "emulator/core/paths.hpp"
#include "emulator/ports/frame_batch.hpp"
#include "emulator/recorder.hpp"
#include "proto/base/time.hpp"
#include "proto/net/packet_socket.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace hapnet::emulator::ports {

/// Network interfaces with a path between each two of them, like a switch that impairs. A frame
/// goes to the interface behind which its destination is. If it is for a group or an unknown
/// destination, it goes to all other interfaces. The switch does not learn addresses. The datagrams
/// of the paths are IP packets; their Ethernet headers are passed on with them. ARP and neighbour
/// discovery pass undisturbed. This class moves frames; EmulatedPath takes every decision.
class Frames {
public:
    /// An interface, and what is behind it.
    struct Place {
        std::string name; // "a"
        std::string interface;
        std::optional<MacAddress> machine{}; // its MAC address; nullopt: not known
    };

    struct Setup {
        std::vector<Place> ends;    // two or more
        bool all_frames = false;    // the conditions apply to every frame
        bool fix_checksums = false; // recomputes those of frames that leave, which hides damage
        bool stops_at_loop = false; // ends the run if frames of one machine arrive on both sides
        // Informs senders about packets that `mtu` drops, like a router
        bool answers_too_big = false;
        /// The cause of packets longer than the MTU, and the remedy for a person. "": the interface
        /// merges segments.
        std::string cure_of_oversized{};

        /// Returns the names of the paths between each two ends: "a-b", "a-c", "b-c". The only path
        /// between two ends has no name. `up` is from the first to the second.
        [[nodiscard]] std::vector<std::string> path_names() const;
    };

    /// An interface, and the counts of the frames that came from it.
    struct End {
        End(const Place& place, Recorder::Lane& recorder, bool fixes_checksums);

        std::string name;
        std::string interface;
        std::optional<MacAddress> machine;
        net::PacketSocket socket;
        FrameBatch leaving;
        std::size_t frame_bytes_max;   // longest frame that its MTU allows, without VLAN tags
        std::uint64_t undisturbed = 0; // frames to which no conditions apply
        std::uint64_t not_ip = 0;
        std::uint64_t oversized = 0;        // longer than the MTU: merged by an interface
        std::uint64_t lost_undisturbed = 0; // undisturbed frames that could not be sent
        std::uint64_t told_too_big = 0;     // "too big" answers sent to this end
    };

    /// Two ends and the path between them.
    struct Pair {
        std::string name;
        EmulatedPath& path;
        std::size_t a; // `up` goes from a to b
        std::size_t b;
        std::uint32_t number;             // number of its pair of interfaces in the capture
        std::uint32_t recorded_as;        // number in the fates; its flows have the next ones
        std::uint64_t unreachable_up = 0; // answers from b that no program listens there
        std::uint64_t unreachable_down = 0;
    };

    /// Adds the paths. Throws std::system_error when an interface cannot be used. The paths and the
    /// recorder must outlive it.
    Frames(const Setup& setup, Paths& paths, Recorder& recorder);

    /// Takes the frames that have arrived, at most one batch an end, and at once sends those that
    /// are not delayed.
    void receive();

    /// Sends frames that are due at `now`. Those that remain are still due.
    void release(base::TimePoint now);

    /// Returns the next message for a person, each only once.
    [[nodiscard]] std::optional<std::string> next_notice();

    /// Returns the reason why the run must end; nullopt: it may continue.
    [[nodiscard]] const std::optional<std::string>& failure() const { return failure_; }

    /// Ensures that from now on the loss of an interface is no failure, because the program behind
    /// it ends.
    void expect_end() { is_end_expected_ = true; }

    [[nodiscard]] const std::deque<End>& ends() const { return ends_; }
    /// Returns the pairs in the order of Setup::path_names().
    [[nodiscard]] const std::deque<Pair>& pairs() const { return pairs_; }

private:
    void pass(std::size_t from);
    void pass(std::size_t from, std::size_t to, const net::ReceivedFrame& received,
              const Frame& frame);
    void count(End& from, const net::ReceivedFrame& received, const Frame& frame);
    void send_leaving();
    void tell_of_oversized(const End& from);
    void watch_interface(const End& end);
    [[nodiscard]] std::optional<std::size_t> end_of(std::span<const std::byte> frame) const;
    [[nodiscard]] Pair& pair_of(std::size_t one, std::size_t other);
    void release(const Pair& pair, EmulatedPath& path, base::TimePoint now);
    bool send_due(const Pair& pair, const FrameWay& way, base::TimePoint now);
    void watch_for_loop(std::size_t from, const Frame& frame);
    void answer_too_big(End& from, std::size_t mtu, std::span<const std::byte> frame);

    Setup setup_;
    Paths& paths_;
    Recorder::Lane& recorder_;
    std::deque<End> ends_;
    std::deque<Pair> pairs_;
    std::vector<Pair*> by_path_; // indexed by the numbers of paths, also of flows
    /// The machines heard last, by a hash of their addresses, and the end where each was heard.
    /// That is enough to find a loop, which repeats frames all the time.
    struct Heard {
        MacAddress who{};
        std::size_t end = 0;
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
