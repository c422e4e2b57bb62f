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

/// How a HID device behaves. Called from one thread at a time.
class HidModel {
public:
    HidModel() = default;
    virtual ~HidModel() = default;
    HidModel(const HidModel&) = delete;
    HidModel& operator=(const HidModel&) = delete;

    // Reports begin with their ID.
    virtual void on_output(std::span<const std::byte> report) = 0;
    virtual void on_feature(std::span<const std::byte> report) = 0;
    /// nullopt: it knows no such report.
    [[nodiscard]] virtual std::optional<std::vector<std::byte>> feature(std::uint8_t id) = 0;
};

/// A HID device in a testbed: the kernel's hidraw in front of a model. All functions may be called
/// from any thread. One reader at a time, as all who have opened the node hear of a report here
/// by one bell.
class HidrawDevice final : private Handler {
public:
    HidrawDevice(Testbed& testbed, HidDescription description, HidModel& model);
    ~HidrawDevice() override;

    /// The device says this. Of 64 that wait unread the newest one is lost, as in the kernel.
    void say(std::vector<std::byte> report);
    /// It takes nothing and says nothing while this is on; who writes waits.
    void stall(bool on);
    /// It is pulled out: for all who have opened it it has gone.
    void unplug();
    /// ... and put in again, as another node: for who opens it anew.
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

    /// What may have to wait.
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
    std::optional<Attachment> attachment_; // last: it ends before what it uses
};

} // namespace hapnet::umockdev
