// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "device/falcon/transport/falcons.hpp"

#include "device/falcon/falcon.hpp"
#include "device/falcon/startup.hpp"
#include "device/falcon/transport/usb_link.hpp"
#include "device/usb_ids.hpp"

#include <algorithm>
#include <array>
#include <fstream>
#include <iterator>
#include <optional>
#include <spdlog/fmt/fmt.h>
#include <utility>
#include <variant>

namespace hapnet::device::falcon {

namespace {

constexpr std::uint8_t vendor_request = LIBUSB_REQUEST_TYPE_VENDOR; // direction: to the device
constexpr unsigned transfer_max_ms = 1000;

using Context = std::unique_ptr<libusb_context, ClaimedUsb::Exit>;

struct Unref {
    void operator()(libusb_device* device) const { libusb_unref_device(device); }
};
struct Close {
    void operator()(libusb_device_handle* handle) const { libusb_close(handle); }
};
using UsbDevice = std::unique_ptr<libusb_device, Unref>;
using Handle = std::unique_ptr<libusb_device_handle, Close>;

DeviceError error_of(int result, const std::string& what)
{
    const auto with = [&](Fault fault) {
        return DeviceError{fault, fmt::format("{}: {}", what, describe(fault)), result};
    };
    switch (result) {
    case LIBUSB_ERROR_ACCESS: return with(Fault::permission);
    case LIBUSB_ERROR_BUSY: return with(Fault::in_use);
    case LIBUSB_ERROR_NO_DEVICE: return with(Fault::disconnected);
    case LIBUSB_ERROR_NOT_FOUND: return with(Fault::not_found);
    case LIBUSB_ERROR_TIMEOUT: return with(Fault::timeout);
    case LIBUSB_ERROR_IO:
    case LIBUSB_ERROR_PIPE:
    case LIBUSB_ERROR_OVERFLOW: return with(Fault::communication);
    default: break;
    }
    return {Fault::internal,
            fmt::format("{}: libusb says {}: {}", what, libusb_error_name(result),
                        describe(Fault::internal)),
            result};
}

Opened<Context> start_libusb()
{
    libusb_context* context = nullptr;
    const int result = libusb_init(&context);
    if (result != LIBUSB_SUCCESS) return tl::unexpected{error_of(result, "libusb")};
    return Context{context};
}

std::vector<UsbDevice> falcons_of(libusb_context* context)
{
    std::vector<UsbDevice> falcons;
    libusb_device** list = nullptr;
    const auto count = libusb_get_device_list(context, &list);
    for (decltype(libusb_get_device_list(context, &list)) i = 0; i < count; ++i) {
        libusb_device_descriptor descriptor{};
        if (libusb_get_device_descriptor(list[i], &descriptor) != LIBUSB_SUCCESS) continue;
        const UsbId* const id = find_usb_id(descriptor.idVendor, descriptor.idProduct);
        if (id == nullptr || id->kind != UsbKind::falcon) continue;
        falcons.emplace_back(libusb_ref_device(list[i]));
    }
    if (count >= 0) libusb_free_device_list(list, 1);
    return falcons;
}

/// Returns a name such as "usb-1-2.3": the bus, then the ports on the path to the device.
std::string port_of(libusb_device* device)
{
    constexpr int depth_max = 7; // longest port path in USB 3.0
    std::array<std::uint8_t, depth_max> ports{};
    const int depth = libusb_get_port_numbers(device, ports.data(), depth_max);
    std::string name = fmt::format("usb-{}", libusb_get_bus_number(device));
    if (depth <= 0) return fmt::format("{}-a{}", name, libusb_get_device_address(device));
    for (int i = 0; i < depth; ++i) {
        name += fmt::format("{}{}", i == 0 ? '-' : '.', ports[static_cast<std::size_t>(i)]);
    }
    return name;
}

std::string serial_of(libusb_device* device, libusb_device_handle* handle)
{
    libusb_device_descriptor descriptor{};
    std::array<unsigned char, 128> text{};
    if (libusb_get_device_descriptor(device, &descriptor) != LIBUSB_SUCCESS ||
        descriptor.iSerialNumber == 0) {
        return port_of(device);
    }
    const int length = libusb_get_string_descriptor_ascii(handle, descriptor.iSerialNumber,
                                                          text.data(), text.size());
    if (length <= 0) return port_of(device);
    return {text.begin(), text.begin() + length};
}

struct Candidate {
    std::string serial;
    Opened<Handle> handle; // the open handle, or why it cannot be opened
};

Candidate open_usb(libusb_device* device)
{
    libusb_device_handle* handle = nullptr;
    const int result = libusb_open(device, &handle);
    if (result != LIBUSB_SUCCESS) {
        const std::string node =
            fmt::format("the Falcon at /dev/bus/usb/{:03}/{:03}", libusb_get_bus_number(device),
                        libusb_get_device_address(device));
        return {port_of(device), tl::unexpected{error_of(result, node)}};
    }
    return {serial_of(device, handle), Handle{handle}};
}

/// Claims the device's interface, if necessary from the kernel's driver for FTDI's chips.
std::optional<DeviceError> claim(libusb_device_handle* handle, const std::string& serial)
{
    libusb_set_auto_detach_kernel_driver(handle, 1);
    const int result = libusb_claim_interface(handle, 0);
    if (result == LIBUSB_SUCCESS) return std::nullopt;
    return error_of(result, "Falcon " + serial);
}

std::optional<DeviceError> error_with(Candidate& candidate)
{
    if (!candidate.handle) return candidate.handle.error();
    libusb_device_handle* const handle = candidate.handle->get();
    // A device that is claimed by the kernel's driver stays with it, because this function only
    // looks.
    if (libusb_kernel_driver_active(handle, 0) == 1) return std::nullopt;
    const int result = libusb_claim_interface(handle, 0);
    if (result != LIBUSB_SUCCESS) return error_of(result, "Falcon " + candidate.serial);
    libusb_release_interface(handle, 0);
    return std::nullopt;
}

Opened<std::vector<std::byte>> firmware_in(const std::string& file)
{
    if (file.empty()) return std::vector<std::byte>{};
    std::ifstream stream{file, std::ios::binary};
    const std::vector<char> text{std::istreambuf_iterator<char>{stream}, {}};
    if (!stream.is_open() || stream.bad() || text.empty()) {
        return device_error(
            Fault::firmware_missing,
            fmt::format("--falcon-firmware: '{}' cannot be read, or is empty", file));
    }
    const auto bytes = std::as_bytes(std::span{text});
    return std::vector<std::byte>{bytes.begin(), bytes.end()};
}

/// Carries out the steps of a Startup, until it is ready.
class Starter {
public:
    Starter(libusb_device_handle* handle, Startup& startup) : handle_{handle}, startup_{startup} {}

    std::optional<DeviceError> run()
    {
        for (;;) {
            const Step step = startup_.step();
            if (std::holds_alternative<Ready>(step)) return std::nullopt;
            if (const auto* refused = std::get_if<Refused>(&step)) return refused->error;
            if (const auto* ask = std::get_if<ChipRequest>(&step)) note(carry_out(*ask));
            if (const auto* say = std::get_if<SendBytes>(&step)) note(carry_out(*say));
            if (const auto* listen = std::get_if<Listen>(&step)) carry_out(*listen);
            if (result_ == LIBUSB_ERROR_NO_DEVICE) return error_of(result_, "the Falcon");
        }
    }

private:
    void note(int result)
    {
        result_ = result;
        if (result == LIBUSB_SUCCESS) {
            startup_.on_done();
        } else {
            startup_.on_silence();
        }
    }

    int carry_out(const ChipRequest& ask)
    {
        return libusb_control_transfer(handle_, vendor_request, ask.request, ask.value, 0, nullptr,
                                       0, transfer_max_ms);
    }

    int carry_out(const SendBytes& say)
    {
        std::vector<unsigned char> bytes(say.bytes.size());
        std::transform(say.bytes.begin(), say.bytes.end(), bytes.begin(),
                       [](std::byte byte) { return std::to_integer<unsigned char>(byte); });
        int sent = 0;
        return libusb_bulk_transfer(handle_, endpoint_out, bytes.data(),
                                    static_cast<int>(bytes.size()), &sent, transfer_max_ms);
    }

    void carry_out(const Listen& listen)
    {
        std::array<unsigned char, usb_packet_bytes> buffer{};
        int size = 0;
        const auto most = std::chrono::ceil<std::chrono::milliseconds>(listen.at_most).count();
        result_ = libusb_bulk_transfer(handle_, endpoint_in, buffer.data(),
                                       static_cast<int>(buffer.size()), &size,
                                       static_cast<unsigned>(most));
        if (result_ != LIBUSB_SUCCESS) {
            startup_.on_silence();
            return;
        }
        const auto bytes = std::as_bytes(std::span{buffer}).first(static_cast<std::size_t>(size));
        startup_.on_heard(bytes.subspan(std::min(ftdi_status_bytes, bytes.size())));
    }

    libusb_device_handle* handle_;
    Startup& startup_;
    int result_ = LIBUSB_SUCCESS;
};

/// Returns the Falcon with this serial number or at this port; for "" the first usable one.
Opened<Candidate> choose(libusb_context* context, const std::string& serial)
{
    std::optional<DeviceError> first_trouble;
    for (const UsbDevice& device : falcons_of(context)) {
        Candidate candidate = open_usb(device.get());
        const bool is_it = candidate.serial == serial || port_of(device.get()) == serial;
        if (!serial.empty() && !is_it) continue;
        auto why = serial.empty() ? error_with(candidate) : std::nullopt;
        if (!why) return candidate;
        if (!first_trouble) first_trouble = std::move(why);
    }
    if (first_trouble) return tl::unexpected{*std::move(first_trouble)};
    const std::string which = serial.empty() ? "no Falcon" : "no Falcon " + serial;
    return device_error(Fault::not_found,
                        fmt::format("{} was found: {}", which, cure_of_not_found));
}

Opened<std::unique_ptr<Device>> start(Context context, Candidate&& candidate,
                                      std::vector<std::byte> firmware)
{
    // From here on both belong together, and the context is destroyed last.
    ClaimedUsb usb{std::move(context), {}};
    if (!candidate.handle) return tl::unexpected{candidate.handle.error()};
    usb.handle.reset(candidate.handle->release());
    if (auto why = claim(usb.handle.get(), candidate.serial)) {
        return tl::unexpected{*std::move(why)};
    }
    Startup startup{std::move(firmware)};
    if (auto why = Starter{usb.handle.get(), startup}.run()) {
        return tl::unexpected{*std::move(why)};
    }
    return std::make_unique<Falcon>(std::make_unique<UsbLink>(std::move(usb)), candidate.serial);
}

} // namespace

std::vector<Found> find_falcons()
{
    std::vector<Found> found;
    const auto context = start_libusb();
    if (!context) return {{identity_of(""), context.error()}};
    for (const UsbDevice& device : falcons_of(context->get())) {
        Candidate candidate = open_usb(device.get());
        auto why = error_with(candidate);
        found.push_back({identity_of(std::move(candidate.serial)), std::move(why)});
    }
    return found;
}

Opened<std::unique_ptr<Device>> open_falcon(const std::string& serial,
                                            const std::string& firmware_file)
{
    auto firmware = firmware_in(firmware_file);
    if (!firmware) return tl::unexpected{std::move(firmware).error()};
    auto context = start_libusb();
    if (!context) return tl::unexpected{std::move(context).error()};
    auto candidate = choose(context->get(), serial);
    if (!candidate) return tl::unexpected{std::move(candidate).error()};
    return start(*std::move(context), *std::move(candidate), *std::move(firmware));
}

} // namespace hapnet::device::falcon
