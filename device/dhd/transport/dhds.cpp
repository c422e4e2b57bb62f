// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "device/dhd/transport/dhds.hpp"

#include "device/dhd/transport/dhd_exchange.hpp"
#include "device/transport/polled_device.hpp"
#include "device/transport/shared_library.hpp"
#include "device/transport/usb_models.hpp"

#include <algorithm>
#include <array>
#include <mutex>
#include <spdlog/fmt/fmt.h>
#include <tuple>
#include <utility>

namespace hapnet::device::dhd {

namespace {

constexpr std::array usual_names{"libdhd.so", "libdhd.so.3", "libdrd.so", "libdrd.so.3"};
constexpr int devices_max = 16; // more than any known program uses

Opened<Functions> load_functions(const std::string& file)
{
    auto library = SharedLibrary::load(file, usual_names);
    if (!library) {
        return device_error(Fault::library_missing,
                            fmt::format("cannot load libdhd, the vendor's library ({}): install "
                                        "the SDK of Force Dimension, or say --dhd-library FILE",
                                        library.error().message));
    }
    Functions all;
    library->find(all.device_count, "dhdGetDeviceCount");
    library->find(all.open_id, "dhdOpenID");
    library->find(all.close, "dhdClose");
    library->find(all.serial_number, "dhdGetSerialNumber");
    library->find(all.system_name, "dhdGetSystemName");
    library->find(all.enable_force, "dhdEnableForce");
    library->find(all.get_status, "dhdGetStatus");
    library->find(all.get_position, "dhdGetPosition");
    library->find(all.get_velocity, "dhdGetLinearVelocity");
    library->find(all.set_force, "dhdSetForce");
    library->find(all.get_button, "dhdGetButton");
    library->find(all.last_error, "dhdErrorGetLast");
    if (library->missing().empty()) return all;
    return device_error(Fault::library_missing,
                        fmt::format("{} is no libdhd that this program knows: it has no {}(); the "
                                    "SDK of Force Dimension since 3.3 has it",
                                    file.empty() ? "libdhd.so" : file, library->missing()));
}

Identity identity_of(std::string serial, std::string model)
{
    return {.backend = "dhd",
            .serial = std::move(serial),
            .model = std::move(model),
            .note = std::string{never_run}};
}

/// Returns the printable ASCII of a text from the library; "" for null.
std::string shown(const char* text)
{
    constexpr std::size_t bytes_max = 200;
    std::string it;
    for (; text != nullptr && *text != '\0' && it.size() < bytes_max; ++text) {
        it += *text >= ' ' && *text <= '~' ? *text : '?';
    }
    return it;
}

/// An open device, with its number and its serial number, so that the library is not asked for them
/// twice.
struct OpenDevice {
    Id id;
    std::string serial;
};

/// Opens the device at this index on the bus, with its motors off. The error is the library's code.
tl::expected<OpenDevice, int> open_at(const Functions& functions, int index)
{
    const int id = functions.open_id(static_cast<Id>(index));
    if (id < 0) return tl::unexpected{functions.last_error()};
    const auto device = static_cast<Id>(id);
    std::ignore = functions.enable_force(0, device);
    unsigned short serial = 0;
    const bool has_serial = functions.serial_number(&serial, device) >= 0;
    return OpenDevice{device, has_serial ? fmt::format("{}", serial) : ""};
}

} // namespace

std::vector<Found> find_dhds(const std::string& library)
{
    std::vector<Found> found;
    for (std::string& model : models_on_usb(UsbKind::force_dimension)) {
        found.push_back({identity_of("", std::move(model)), {}});
    }
    if (found.empty() && library.empty()) return found; // no sign of a device
    const auto functions = load_functions(library);
    if (found.empty()) found.push_back({identity_of("", "first device of libdhd"), {}});
    if (functions) return found;
    for (Found& one : found) one.unusable = functions.error();
    return found;
}

Opened<std::unique_ptr<Device>> open_dhd(const std::string& serial, const std::string& library)
{
    // The library numbers its devices for the whole process.
    static std::mutex mutex;
    const std::lock_guard lock{mutex};
    const auto functions = load_functions(library);
    if (!functions) return tl::unexpected{functions.error()};
    int code = error::no_device;
    const int count = std::min(functions->device_count(), devices_max);
    for (int index = 0; index < count; ++index) {
        const auto open = open_at(*functions, index);
        if (!open) {
            code = open.error();
            continue;
        }
        if (!serial.empty() && open->serial != serial) {
            std::ignore = functions->close(open->id);
            continue;
        }
        const std::string name = shown(functions->system_name(open->id));
        return std::make_unique<PolledDevice>(
            std::make_unique<DhdExchange>(*functions, open->id),
            identity_of(open->serial, fmt::format("{} behind libdhd", name)), capabilities());
    }
    const Fault fault = fault_of(code) == Fault::in_use ? Fault::in_use : Fault::not_found;
    return device_error(fault, describe_error(serial, code), code);
}

} // namespace hapnet::device::dhd
