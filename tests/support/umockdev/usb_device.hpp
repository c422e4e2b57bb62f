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

/// A request of a host to a USB device's endpoint 0: USB 2.0, table 9-2.
struct UsbSetup {
    std::uint8_t type = 0;
    std::uint8_t request = 0;
    std::uint16_t value = 0;
    std::uint16_t index = 0;
    std::uint16_t length = 0;
};

/// The behaviour of a USB device except its descriptors. Called from one thread at a time.
class UsbModel {
public:
    UsbModel() = default;
    virtual ~UsbModel() = default;
    UsbModel(const UsbModel&) = delete;
    UsbModel& operator=(const UsbModel&) = delete;

    /// Returns the answer to a request, empty if it has none; nullopt: the device refuses it.
    [[nodiscard]] virtual std::optional<std::vector<std::byte>>
    on_control(const UsbSetup& setup, std::span<const std::byte> data) = 0;
    virtual void on_bulk_out(std::span<const std::byte> bytes) = 0;
    /// Returns the device's data, at most `size` bytes; nullopt: none yet, to be asked again.
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

    /// Lets all transfers wait while this is on.
    void stall(bool on);
    /// Unplugs it: pending transfers fail, and so do all further requests of its openers.
    void unplug();
    /// Plugs it in again, for programs that reopen it.
    void plug_in();
    /// Looks at or changes the model between two of its calls.
    template <typename Action>
    auto with_model(Action action)
    {
        const std::lock_guard lock{mutex_};
        return action();
    }

    [[nodiscard]] const UsbDescription& description() const { return usb_; }

    /// True if the kernel's own driver holds it. Only for a description that names a driver.
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
    std::map<const void*, bool> openers_; // true if it has gone since they opened it
    const void* owner_ = nullptr;         // of the interface
    bool kernel_has_it_ = false;
    bool stalled_ = false;
    std::optional<Attachment> attachment_; // the last member, because it uses the others
};

} // namespace hapnet::umockdev
