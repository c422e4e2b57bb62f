// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <cstdint>
#include <type_traits>

namespace hapnet::peer {

/// Lets one thread ask another for a value, which that one gives when it comes by. Neither waits
/// for the other, and nothing is allocated: there is one place, which belongs to the giver while
/// it is asked, and else to the asker.
template <typename Value>
class Handover {
    static_assert(std::is_trivially_copyable_v<Value>);

public:
    // Who asks.
    /// Asks for a new value, unless that has been done already.
    void ask()
    {
        if (state_.load(std::memory_order_acquire) == State::idle) {
            state_.store(State::asked, std::memory_order_release);
        }
    }
    /// Takes what was given, once; whether something was.
    [[nodiscard]] bool take(Value& into)
    {
        if (state_.load(std::memory_order_acquire) != State::given) return false;
        into = value_;
        state_.store(State::idle, std::memory_order_release);
        return true;
    }

    // Who gives.
    /// Has `fill(value)` write the value, if somebody asked for it.
    template <typename Fill>
    void give_if_asked(Fill fill)
    {
        if (state_.load(std::memory_order_acquire) != State::asked) return;
        fill(value_);
        state_.store(State::given, std::memory_order_release);
    }

private:
    enum class State : std::uint8_t { idle, asked, given };

    std::atomic<State> state_{State::idle};
    Value value_{};
};

} // namespace hapnet::peer
