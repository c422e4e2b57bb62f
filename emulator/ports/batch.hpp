// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "emulator/core/capture/pcapng.hpp"
#include "emulator/core/emulated_path.hpp"
#include "emulator/core/flow/packet_facts.hpp"
#include "emulator/core/path_name.hpp"
#include "emulator/recorder.hpp"
#include "proto/base/inplace_vector.hpp"
#include "proto/base/ip_marks.hpp"
#include "proto/net/endpoint.hpp"
#include "proto/net/udp_socket.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <tuple>
#include <vector>

namespace hapnet::emulator::ports {

/// One direction of a path, and the place where it is recorded.
struct Way {
    EmulatedPath& path;
    Direction direction;
    Recorder::Lane& recorder;
    std::uint32_t recorded_as = 0; // the path's number in the fates; its flows have the next ones
    std::uint32_t pair = 0;        // number of its pair of interfaces in the capture
};

/// The side where the datagrams of one direction enter.
struct Entrance {
    CaptureSide side;
    const net::Endpoint& local; // address of the socket
};

/// Returns the properties of a datagram that filters of flows can match. An unknown destination has
/// neither address nor port.
[[nodiscard]] PacketFacts facts_of(const net::Received& datagram,
                                   const std::optional<net::Endpoint>& destination);

/// The side where the datagrams of one direction leave.
struct Exit {
    CaptureSide side;
    net::UdpSocket& socket;
    const net::Endpoint& local; // address of the socket
    const std::optional<net::Endpoint>& destination;
};

/// Datagrams that leave in one direction, from a path and its flows, collected and sent together.
/// Call flush() before their bytes become invalid.
class Batch {
public:
    Batch(const Way& way, const Exit& exit) : way_{way}, exit_{exit} {}

    /// Hands a datagram that has arrived to the path that it takes, and adds it to the batch if it
    /// is not delayed.
    void take(const net::Received& datagram, const Entrance& entrance);

    /// Adds a departure of the path, or of a flow beside it.
    void add(EmulatedPath& path, const Datagram& departure)
    {
        paths_.push_back(&path);
        departures_.push_back(departure);
        bytes_.push_back(departure.bytes);
        marks_.push_back(departure.marks);
        if (departures_.full()) flush();
    }

    /// Sends the batch. Ensures that there is a destination: without one, the path admits no
    /// datagram.
    void flush();

private:
    void on_sent(EmulatedPath& path, const Datagram& departure, base::TimePoint at);

    Way way_;
    Exit exit_;
    template <typename T>
    using Each = base::InplaceVector<T, net::BatchSender::batch_max>;
    Each<EmulatedPath*> paths_; // path of each departure
    Each<Datagram> departures_;
    Each<std::span<const std::byte>> bytes_;
    Each<base::IpMarks> marks_;
};

/// Registers a path and its flows with the recorder. Returns the number of the path; its flows have
/// the next numbers. The calls must not overlap.
[[nodiscard]] inline std::uint32_t add_to(Recorder& recorder, const std::string& path,
                                          std::span<const Flow> flows)
{
    const std::uint32_t number = recorder.add_path(path);
    for (const Flow& flow : flows) std::ignore = recorder.add_path(flow_path(path, flow.name));
    return number;
}

/// Stores `owner` under the number of the path and under the numbers of the flows beside it.
template <typename Owner>
void put_by_number(std::vector<Owner*>& owners, const EmulatedPath& path, Owner* owner)
{
    const auto put = [&](const EmulatedPath& one) {
        owners.resize(std::max(owners.size(), one.number() + 1));
        owners[one.number()] = owner;
    };
    put(path);
    if (const Branches* branches = path.branches()) {
        for (const EmulatedPath* flow : branches->paths()) put(*flow);
    }
}

/// The greatest number of batches of each direction that one release() sends. They hold twice the
/// datagrams of one receive() with a copy of each. So a flood cannot fill the queue by arriving
/// faster than it is sent, and what it left in the queue becomes less while it continues.
inline constexpr int release_rounds_max = 32;

/// Sends at most one batch of the datagrams that are due at `now` in a direction. Returns true if
/// the batch was full.
bool send_due(const Way& way, const Exit& exit, base::TimePoint now);

/// Sends the due datagrams of both directions in turn, with a limit so that arrivals do not have to
/// wait long. The remaining datagrams stay due.
void send_due(const Way& up, const Exit& up_exit, const Way& down, const Exit& down_exit,
              base::TimePoint now);

} // namespace hapnet::emulator::ports
