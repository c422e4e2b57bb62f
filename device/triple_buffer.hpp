// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <atomic>
#include <cstdint>

namespace hapnet::device {

/// Passes the latest value from one thread to another; neither ever waits. One of three buffers
/// belongs to the writer, one to the reader, and the third changes hands.
template <typename T>
class TripleBuffer {
public:
    /// Stores a value. For the writing thread.
    void put(const T& value)
    {
        places_[given_] = value;
        const auto offered = static_cast<std::uint8_t>(given_ | is_new);
        given_ = between_.exchange(offered, std::memory_order_acq_rel) & place;
    }
    /// Takes the newest value. Returns true if one has come since the last call. For the reading
    /// thread.
    bool take()
    {
        if ((between_.load(std::memory_order_relaxed) & is_new) == 0) return false;
        taken_ = between_.exchange(taken_, std::memory_order_acq_rel) & place;
        return true;
    }
    /// Returns the value that was taken last. For the reading thread.
    [[nodiscard]] const T& value() const { return places_[taken_]; }

private:
    static constexpr std::uint8_t place = 3;
    static constexpr std::uint8_t is_new = 4;

    std::array<T, 3> places_{};
    std::uint8_t given_ = 0;
    std::atomic<std::uint8_t> between_{1};
    std::uint8_t taken_ = 2;
};

} // namespace hapnet::device
