// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <memory>
#include <string>
#include <vector>

namespace hapnet::test {

/// A service that behaves as the public reference of the vendor's local service describes: after a
/// connection it lists its devices, and then sends one state for each message. It has one device,
/// 049D, which a hand holds. Each connection has a thread.
class FakeInverseService {
public:
    FakeInverseService();
    /// Ends the connections.
    ~FakeInverseService();
    FakeInverseService(const FakeInverseService&) = delete;
    FakeInverseService& operator=(const FakeInverseService&) = delete;

    [[nodiscard]] std::uint16_t port() const;

    enum class Fate : std::uint8_t {
        calibrated,
        pressed, // button a of its grip
        unplugged,
        unpowered,
        garbled, // states are no JSON
        mute,    // it neither reads nor answers
        permuted // it was configured to permute its axes
    };
    void set(Fate fate, bool on);
    /// Ends all connections, and accepts no more.
    void stop();

    /// Returns all forces that it received, in its frame, in their order.
    [[nodiscard]] std::vector<glm::dvec3> forces() const;

private:
    struct State;
    std::unique_ptr<State> state_;
};

} // namespace hapnet::test
