// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <cstdint>
#include <type_traits>

namespace hapnet::peer::loop {

/// Passes values between two threads: the reader requests one, and the filler writes it when it
/// next checks. Neither waits for the other, and nothing is allocated. The only slot belongs to the
/// filler from the request until it is filled, and otherwise to the reader.
template <typename Value>
class SnapshotSlot {
    static_assert(std::is_trivially_copyable_v<Value>);

public:
    // Requests a new value, unless one is requested or waiting already. For the reader.
    void request()
    {
        if (state_.load(std::memory_order_acquire) == State::idle) {
            state_.store(State::requested, std::memory_order_release);
        }
    }
    /// Takes the value that was filled in, once. Returns false if there is none.
    [[nodiscard]] bool take(Value& into)
    {
        if (state_.load(std::memory_order_acquire) != State::filled) return false;
        into = value_;
        state_.store(State::idle, std::memory_order_release);
        return true;
    }

    // Calls `fill(value)` to write the value, if one is requested. For the filler.
    template <typename Fill>
    void fill_if_requested(Fill fill)
    {
        if (state_.load(std::memory_order_acquire) != State::requested) return;
        fill(value_);
        state_.store(State::filled, std::memory_order_release);
    }

private:
    enum class State : std::uint8_t { idle, requested, filled };

    std::atomic<State> state_{State::idle};
    Value value_{};
};

} // namespace hapnet::peer::loop
