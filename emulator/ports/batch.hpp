// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "emulator/core/capture/pcapng.hpp"
#include "emulator/core/emulated_path.hpp"
#include "emulator/recorder.hpp"
#include "proto/net/endpoint.hpp"
#include "proto/net/udp_socket.hpp"

#include <array>
#include <cstddef>
#include <span>

namespace hapnet::emulator::ports {

/// Where the datagrams of one direction leave.
struct Exit {
    CaptureSide side;
    net::UdpSocket& socket;
    const net::Endpoint& local; // of the socket
    const std::optional<net::Endpoint>& destination;
};

/// What leaves in one direction: gathered and sent together. Flush it before the bytes go.
class Batch {
public:
    Batch(EmulatedPath& path, Direction direction, const Exit& exit, Recorder& recorder)
        : path_{path}, direction_{direction}, exit_{exit}, recorder_{recorder}
    {}

    void add(const Datagram& departure)
    {
        departures_[count_] = departure;
        bytes_[count_] = departure.bytes;
        ++count_;
        if (count_ == departures_.size()) flush();
    }

    /// Ensures that there is a destination: without one, the path admits no datagram.
    void flush();

private:
    void on_sent(const Datagram& departure, base::TimePoint at);

    EmulatedPath& path_;
    Direction direction_;
    Exit exit_;
    Recorder& recorder_;
    std::size_t count_ = 0;
    std::array<Datagram, net::BatchSender::batch_max> departures_;
    std::array<std::span<const std::byte>, net::BatchSender::batch_max> bytes_;
};

/// Sends at most one batch of what is due at `now` in a direction; returns whether it was a whole
/// one.
bool send_due(EmulatedPath& path, Direction direction, const Exit& exit, Recorder& recorder,
              base::TimePoint now);

/// Batches of each direction that one release() sends at most. Twice what one receive() takes with
/// a copy of each: a flood cannot fill the queue by being taken faster than it is sent, and what
/// it left behind there shrinks while it goes on.
inline constexpr int release_rounds_max = 32;

} // namespace hapnet::emulator::ports
