// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "tests/support/umockdev/handler.hpp"
#include "tests/support/umockdev/usb_description.hpp"

#include <cstddef>
#include <cstdint>
#include <deque>
#include <map>
#include <mutex>
#include <optional>
#include <span>
#include <vector>

namespace hapnet::umockdev {

/// What a host asks of a USB device's endpoint 0: USB 2.0, table 9-2.
struct UsbSetup {
    std::uint8_t type = 0;
    std::uint8_t request = 0;
    std::uint16_t value = 0;
    std::uint16_t index = 0;
    std::uint16_t length = 0;
};

/// How a USB device behaves; its descriptors are seen to. Called from one thread at a time.
class UsbModel {
public:
    UsbModel() = default;
    virtual ~UsbModel() = default;
    UsbModel(const UsbModel&) = delete;
    UsbModel& operator=(const UsbModel&) = delete;

    /// The answer to a request, empty where it only does something; nullopt: it refuses it.
    [[nodiscard]] virtual std::optional<std::vector<std::byte>>
    on_control(const UsbSetup& setup, std::span<const std::byte> data) = 0;
    virtual void on_bulk_out(std::span<const std::byte> bytes) = 0;
    /// What it has to say now, at most `size` bytes; nullopt: nothing yet, it will be asked again.
    [[nodiscard]] virtual std::optional<std::vector<std::byte>> on_bulk_in(std::size_t size) = 0;
    /// The interface was released, or its program has ended.
    virtual void on_released() {}
};

/// A USB device in a testbed: the kernel's usbfs in front of a model. All functions may be called
/// from any thread.
class UsbDevice final : private Handler {
public:
    UsbDevice(Testbed& testbed, UsbDescription description, UsbModel& model);
    ~UsbDevice() override;

    /// It answers no transfer while this is on; those wait.
    void stall(bool on);
    /// It is pulled out: what is under way fails, and so does all that who opened it asks then.
    void unplug();
    /// ... and put in again: for who opens it anew.
    void plug_in();
    /// Looks at or changes the model between two of its calls.
    template <typename Action>
    auto with_model(Action action)
    {
        const std::lock_guard lock{mutex_};
        return action();
    }

    [[nodiscard]] const UsbDescription& description() const { return usb_; }

    /// Whether the kernel's own driver has hold of it; only where the description names one.
    [[nodiscard]] bool kernel_has_it();

private:
    /// A transfer under way.
    struct Transfer {
        const void* opener = nullptr;
        Memory urb;
        Memory buffer;
    };
    enum class Step : std::uint8_t { done, waits };

    [[nodiscard]] bool on_ioctl(const Request& request) override;
    void on_closed(const void* opener) override;
    [[nodiscard]] bool answer(const Request& request);
    void submit(const Request& request);
    void reap(const Request& request);
    void discard(const Request& request);
    void claim(const Request& request, bool from_kernel);
    void release(const void* opener);
    void reconnect_kernel(const Request& request);
    void work();
    [[nodiscard]] Step carry_out(Transfer& transfer);
    void control(Transfer& transfer);
    [[nodiscard]] std::optional<std::vector<std::byte>> reply(const UsbSetup& setup,
                                                              std::span<const std::byte> data);
    void finish(Transfer& transfer, int status, std::size_t count);

    Testbed& testbed_;
    UsbDescription usb_;
    UsbModel& model_;
    std::mutex mutex_;
    std::deque<Transfer> under_way_; // in the order in which they came
    std::deque<Transfer> done_;
    std::map<const void*, bool> openers_; // and whether it has gone since they opened it
    const void* owner_ = nullptr;         // of the interface
    bool kernel_has_it_ = false;
    bool stalled_ = false;
    std::optional<Attachment> attachment_; // last: it ends before what it uses
};

} // namespace hapnet::umockdev
