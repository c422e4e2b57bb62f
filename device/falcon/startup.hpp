// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "device/falcon/packet.hpp"
#include "device/fault.hpp"
#include "proto/base/time.hpp"

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <variant>
#include <vector>

namespace hapnet::device::falcon {

/// A request to the FTDI chip between the USB and the Falcon.
struct ChipRequest {
    std::uint8_t request = 0;
    std::uint16_t value = 0;

    friend bool operator==(const ChipRequest&, const ChipRequest&) = default;
};
/// Bytes for the Falcon.
struct SendBytes {
    std::vector<std::byte> bytes;
};
/// Wait for one answer of the chip, which may contain no byte from the Falcon.
struct Listen {
    base::Duration at_most;
};
/// The Falcon's firmware runs and answers.
struct Ready {};
/// The device cannot start, for this reason.
struct Refused {
    DeviceError error;
};
using Step = std::variant<ChipRequest, SendBytes, Listen, Ready, Refused>;

/// Brings a Falcon from its loader to its running firmware, as libnifalcon does
/// (src/comm/FalconCommLibUSB.cpp, src/core/FalconFirmware.cpp). It asks whether the firmware runs
/// already. If it does not, it loads the firmware, up to 5 times, because the first attempts often
/// fail. Does no I/O and reads no clock: carry out step(), report the outcome, and repeat this
/// until the step is Ready or Refused.
class Startup {
public:
    /// `firmware` is the contents of a firmware file of Novint; empty: there is none.
    explicit Startup(std::vector<std::byte> firmware);

    [[nodiscard]] const Step& step() const { return step_; }

    /// Notes that a ChipRequest or a SendBytes was carried out.
    void on_done();
    /// Takes the bytes that Listen received; empty: the chip had none from the Falcon.
    void on_heard(std::span<const std::byte> bytes);
    /// Notes that Listen received no answer in its time, or that another step could not be carried
    /// out in time.
    void on_silence();

    static constexpr int attempts_max = 5;

private:
    enum class Phase : std::uint8_t { greet, call_loader, call_fast_loader, load };
    enum class Answer : std::uint8_t { incomplete, right, wrong };

    void begin(Phase phase);
    void advance();
    void say();
    void next_phase();
    void next_attempt();
    void refuse(Fault fault, std::string message);
    [[nodiscard]] std::span<const std::byte> chunk() const;
    [[nodiscard]] Answer answer_in(std::span<const std::byte> bytes);

    std::vector<std::byte> firmware_;
    Step step_;
    /// Requests that prepare this phase and are still to be made, the last one first.
    std::vector<ChipRequest> plan_;
    Phase phase_ = Phase::greet;
    PacketFinder finder_;
    std::vector<std::byte> heard_; // bytes received since the last say()
    std::size_t loaded_ = 0;       // bytes of the firmware that were echoed correctly
    int tries_ = 0;                // number of say() calls in this phase
    int empty_ = 0;                // answers without a byte since the last say()
    int attempts_ = 0;             // number of attempts to load the firmware
};

} // namespace hapnet::device::falcon
