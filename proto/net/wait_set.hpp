// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace hapnet::net {

/// The operations that a descriptor is ready for.
struct Ready {
    std::uint64_t key = 0; // the key given to add()
    bool is_readable = false;
    bool is_writable = false;
    bool is_gone = false; // the other side has closed both directions of the connection
};

/// Many descriptors combined into one, which is readable while any of them is ready for an
/// operation of interest.
class WaitSet {
public:
    struct Interest {
        bool to_read = false;
        bool to_write = false;

        friend bool operator==(const Interest&, const Interest&) = default;
    };

    /// Throws std::system_error.
    WaitSet();
    ~WaitSet();
    WaitSet(const WaitSet&) = delete;
    WaitSet& operator=(const WaitSet&) = delete;

    /// Adds a descriptor. It leaves the set when it is closed.
    void add(int descriptor, std::uint64_t key, Interest interest);
    void change(int descriptor, std::uint64_t key, Interest interest);

    /// Returns descriptors that are ready now: at least some of them, valid until the next call.
    /// Never blocks.
    [[nodiscard]] std::span<const Ready> ready();

    [[nodiscard]] int descriptor() const { return descriptor_; }

private:
    static constexpr std::size_t batch_max = 32;

    int descriptor_ = -1;
    std::array<Ready, batch_max> ready_{};
};

} // namespace hapnet::net
