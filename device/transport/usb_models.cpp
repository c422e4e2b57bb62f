// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "device/transport/usb_models.hpp"

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <spdlog/fmt/fmt.h>

namespace hapnet::device {

namespace {

namespace fs = std::filesystem;

/// Returns a number in the kernel's hexadecimal digits; 0 when there is none.
std::uint16_t usb_number_in(const fs::path& file)
{
    std::ifstream in{file};
    std::uint16_t number = 0;
    in >> std::hex >> number;
    return number;
}

} // namespace

std::vector<std::string> models_on_usb(UsbKind kind)
{
    std::vector<std::string> models;
    std::error_code error;
    for (const auto& entry : fs::directory_iterator{"/sys/bus/usb/devices", error}) {
        const std::uint16_t vendor = usb_number_in(entry.path() / "idVendor");
        const std::uint16_t product = usb_number_in(entry.path() / "idProduct");
        const UsbId* const id = find_usb_id(vendor, product);
        if (id == nullptr || id->kind != kind) continue;
        models.push_back(fmt::format("{} (USB {:04x}:{:04x})", id->name, vendor, product));
    }
    return models;
}

} // namespace hapnet::device
