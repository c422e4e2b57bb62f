// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include <bitset>
#include <linux/input.h>
#include <span>
#include <string>

namespace hapnet::peer::loop {

/// The pressed keys of an input device, from its events. Does no I/O.
class KeysDown {
public:
    /// Takes events. Returns false if the kernel has dropped some; the keys must then be read
    /// again.
    [[nodiscard]] bool on_events(std::span<const input_event> events);
    /// Sets the state of all keys, one bit each, in the format of EVIOCGKEY.
    void set(std::span<const unsigned char> bits);

    [[nodiscard]] bool any() const { return down_.any(); }

private:
    std::bitset<KEY_CNT> down_;
};

/// A foot switch, or any other input device of the kernel with keys. It is held while one of its
/// keys is pressed. It is grabbed, so that its keys have no other effect meanwhile. After it was
/// unplugged or could not be read, it counts as released for good.
class EvdevSwitch {
public:
    /// Opens and grabs "/dev/input/...". Throws std::system_error naming it.
    explicit EvdevSwitch(const std::string& path);
    ~EvdevSwitch();
    EvdevSwitch(EvdevSwitch&& other) noexcept;
    EvdevSwitch& operator=(EvdevSwitch&& other) noexcept;
    EvdevSwitch(const EvdevSwitch&) = delete;
    EvdevSwitch& operator=(const EvdevSwitch&) = delete;

    /// Processes the events since the last call. Returns true while the switch is held. Never
    /// blocks, never allocates.
    [[nodiscard]] bool is_held();

private:
    [[nodiscard]] bool read_keys();
    void give_up();

    int descriptor_ = -1; // -1: released for good
    KeysDown keys_;
};

} // namespace hapnet::peer::loop
