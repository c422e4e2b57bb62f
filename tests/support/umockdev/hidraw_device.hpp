// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "tests/support/umockdev/handler.hpp"

#include <cstddef>
#include <cstdint>
#include <deque>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace hapnet::umockdev {

/// A HID device at the USB, as sysfs shows it.
struct HidDescription {
    std::uint16_t vendor = 0;
    std::uint16_t product = 0;
    std::string name{};
    std::string serial{};
    std::vector<std::byte> report_descriptor{};
    int number = 0; // of its hidraw node; each device has another
};

/// The behaviour of a HID device. Called from one thread at a time.
class HidModel {
public:
    HidModel() = default;
    virtual ~HidModel() = default;
    HidModel(const HidModel&) = delete;
    HidModel& operator=(const HidModel&) = delete;

    // Reports begin with their ID.
    virtual void on_output(std::span<const std::byte> report) = 0;
    virtual void on_feature(std::span<const std::byte> report) = 0;
    /// nullopt: there is no such report.
    [[nodiscard]] virtual std::optional<std::vector<std::byte>> feature(std::uint8_t id) = 0;
};

/// A HID device in a testbed: the kernel's hidraw in front of a model. All functions may be called
/// from any thread. Only one reader at a time, because all openers of the node share one bell.
class HidrawDevice final : private Handler {
public:
    HidrawDevice(Testbed& testbed, HidDescription description, HidModel& model);
    ~HidrawDevice() override;

    /// Sends a report of the device. Of 64 unread reports the newest is lost, as in the kernel.
    void say(std::vector<std::byte> report);
    /// Makes the device silent; a writer waits.
    void stall(bool on);
    /// Unplugs it for all programs that have opened it.
    void unplug();
    /// Plugs it in again, as another node, for programs that reopen it.
    void plug_in();
    /// Looks at or changes the model between two of its calls.
    template <typename Action>
    auto with_model(Action action)
    {
        const std::lock_guard lock{mutex_};
        return action();
    }

    [[nodiscard]] std::string node() const; // "/dev/hidraw0"

private:
    [[nodiscard]] bool on_ioctl(const Request& request) override;
    [[nodiscard]] bool on_read(const Request& request) override;
    [[nodiscard]] bool on_write(const Request& request) override;

    /// A request that may have to wait.
    struct Held {
        Request request;
        bool is_write = false;
    };

    void attach();
    void carry_out(const Held& held);
    void set_feature(const Request& request);
    void get_feature(const Request& request);
    void silence(); // no report waits any more

    Testbed& testbed_;
    HidDescription hid_;
    HidModel& model_;
    std::mutex mutex_;
    std::deque<std::vector<std::byte>> waiting_;
    std::vector<Held> held_up_; // while it is stalled
    int master_ = -1;           // the other end of the node, which is a terminal
    int slave_ = -1;
    bool stalled_ = false;
    bool has_gone_ = false;
    std::optional<Attachment> attachment_; // the last member, because it uses the others
};

} // namespace hapnet::umockdev
