// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "emulator/core/emulated_path.hpp"
#include "emulator/recorder.hpp"
#include "proto/base/inplace_vector.hpp"
#include "proto/net/packet_socket.hpp"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace hapnet::emulator::ports {

/// One direction of a path between two interfaces, or of a flow beside it.
struct FrameWay {
    EmulatedPath* path = nullptr;
    Direction direction = Direction::up;
    std::uint32_t pair = 0; // number of its pair of interfaces in the capture
};

/// Frames that leave from one interface, from all paths that end there, collected and sent
/// together. Flush them before their bytes become invalid.
class FrameBatch {
public:
    /// `fixes_checksums`: recompute the checksums of all frames to which conditions applied. The
    /// socket and the recorder must outlive the batch.
    FrameBatch(net::PacketSocket& socket, Recorder::Lane& recorder, bool fixes_checksums)
        : socket_{socket}, recorder_{recorder}, fixes_checksums_{fixes_checksums}
    {}

    void add(const FrameWay& way, const Datagram& departure);
    /// Adds a frame to which the conditions do not apply. If the system does not take the frame, it
    /// is counted in `lost`, which must outlive the batch.
    void add_undisturbed(std::span<const std::byte> bytes, std::uint64_t& lost);
    void flush();

private:
    struct Entry {
        FrameWay way{}; // without a path the frame passes undisturbed
        std::uint64_t* lost = nullptr;
        Datagram departure{};
    };

    [[nodiscard]] std::span<const std::byte> as_it_leaves(const Datagram& departure);
    void add_bytes(std::span<const std::byte> bytes);
    void on_sent(const Entry& entry, std::span<const std::byte> bytes, base::TimePoint at);

    net::PacketSocket& socket_;
    Recorder::Lane& recorder_;
    bool fixes_checksums_;
    template <typename T>
    using Each = base::InplaceVector<T, net::PacketSocket::batch_max>;
    Each<Entry> entries_;
    Each<std::span<const std::byte>> bytes_;
    std::vector<std::vector<std::byte>> changed_; // copies of frames that leave with changes
};

} // namespace hapnet::emulator::ports
