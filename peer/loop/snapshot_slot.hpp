// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <cstdint>
#include <type_traits>

namespace hapnet::peer::loop {

/// One thread requests a value from another, which fills it in when it comes by. Neither waits for
/// the other and nothing is allocated: the one slot belongs to the filler from the request until it
/// is filled, and otherwise to the reader.
template <typename Value>
class SnapshotSlot {
    static_assert(std::is_trivially_copyable_v<Value>);

public:
    // The reader's side.
    /// Requests a new value, unless one is requested or filled in already.
    void request()
    {
        if (state_.load(std::memory_order_acquire) == State::idle) {
            state_.store(State::requested, std::memory_order_release);
        }
    }
    /// Takes the value that was filled in, once; false when there is none.
    [[nodiscard]] bool take(Value& into)
    {
        if (state_.load(std::memory_order_acquire) != State::filled) return false;
        into = value_;
        state_.store(State::idle, std::memory_order_release);
        return true;
    }

    // The filler's side.
    /// Has `fill(value)` write the value, if one is requested.
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
