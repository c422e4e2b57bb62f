// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include <bitset>
#include <linux/input.h>
#include <span>
#include <string>

namespace hapnet::peer::loop {

/// The keys of an input device that are down, from its events. Pure.
class KeysDown {
public:
    /// Returns false when the kernel has dropped events: then the keys must be read again.
    [[nodiscard]] bool on_events(std::span<const input_event> events);
    /// Sets the state of all keys, one bit each, as EVIOCGKEY gives them.
    void set(std::span<const unsigned char> bits);

    [[nodiscard]] bool any() const { return down_.any(); }

private:
    std::bitset<KEY_CNT> down_;
};

/// A foot switch, or any other input device with keys, of the kernel: held while one of its keys is
/// down. It is grabbed, so that its keys do nothing else meanwhile. An input that was pulled out,
/// or that cannot be read, counts as released from then on.
class EvdevSwitch {
public:
    /// Opens and grabs "/dev/input/...". Throws std::system_error naming it.
    explicit EvdevSwitch(const std::string& path);
    ~EvdevSwitch();
    EvdevSwitch(EvdevSwitch&& other) noexcept;
    EvdevSwitch& operator=(EvdevSwitch&& other) noexcept;
    EvdevSwitch(const EvdevSwitch&) = delete;
    EvdevSwitch& operator=(const EvdevSwitch&) = delete;

    /// Takes in what has happened since the last call. Never blocks, never allocates.
    [[nodiscard]] bool is_held();

private:
    [[nodiscard]] bool read_keys();
    void give_up();

    int descriptor_ = -1; // -1: released for good
    KeysDown keys_;
};

} // namespace hapnet::peer::loop
