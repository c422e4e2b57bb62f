// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "device/omni1394/link.hpp"
#include "device/omni1394/registers.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>

namespace hapnet::device::omni1394 {

/// A register to read, or to write.
struct RegisterAccess {
    std::uint64_t address = 0;
    std::size_t size = 0;
    bool writes = false;
    std::array<std::byte, 4> bytes{}; // bytes to write: the first `size` of these

    [[nodiscard]] std::span<const std::byte> to_write() const
    {
        return std::span{bytes}.first(size);
    }
};

/// The dialogue that makes an Omni stream, step by step: reading its identity, setting the
/// channels, and starting the stream. It does no I/O: carry out the access that next() returns, and
/// pass the answer to on_answer().
class StartSequence {
public:
    StartSequence(const Channels& channels, bool writes_dubious_register)
        : channels_{channels}, writes_dubious_register_{writes_dubious_register}
    {}

    /// Returns the next access; nullopt: the sequence is over, whether it succeeded or not.
    [[nodiscard]] std::optional<RegisterAccess> next() const;
    /// Takes the answer to the access that next() returned: the bytes that were read, or none after
    /// a write.
    void on_answer(std::span<const std::byte> bytes);

    [[nodiscard]] bool is_done() const { return step_ == Step::done; }
    /// Returns the reason for its failure; "" while there is none.
    [[nodiscard]] const std::string& failure() const { return failure_; }
    /// Returns the serial number that is printed on the device; "" until it is known.
    [[nodiscard]] const std::string& serial() const { return serial_; }

private:
    enum class Step : std::uint8_t {
        model,
        serial,
        to_device_channel,
        to_host_channel,
        to_host_channel_again, // reads to_host_channel back
        dubious,
        control, // reads the control register
        stream,  // writes the control register with the streaming bit
        done,
        failed,
    };
    void go_to(Step step) { step_ = step; }
    void fail(std::string why);

    Channels channels_;
    bool writes_dubious_register_;
    Step step_ = Step::model;
    std::byte control_{0};
    std::string serial_;
    std::string failure_;
};

/// Returns the access that ends the streaming, the last one to the device.
[[nodiscard]] RegisterAccess stop_streaming();

} // namespace hapnet::device::omni1394
