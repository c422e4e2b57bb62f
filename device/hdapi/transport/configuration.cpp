// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "device/hdapi/transport/configuration.hpp"

#include "device/usb_ids.hpp"

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <spdlog/fmt/fmt.h>

namespace hapnet::device::hdapi {

namespace {

namespace fs = std::filesystem;

std::string variable(const char* name)
{
    const char* value = std::getenv(name);
    return value == nullptr ? "" : value;
}

/// The places named by guides of the vendor and of others; the first that exists counts.
std::vector<fs::path> configuration_folders()
{
    std::vector<fs::path> folders;
    if (const auto home = variable("GTDD_HOME"); !home.empty()) {
        folders.push_back(fs::path{home} / "config");
    }
    if (const auto home = variable("HOME"); !home.empty()) {
        folders.push_back(fs::path{home} / ".3dsystems" / "config");
    }
    folders.emplace_back("/usr/share/3DSystems/config");
    return folders;
}

/// A number in the kernel's hexadecimal digits; 0 when there is none.
std::uint16_t usb_number_in(const fs::path& file)
{
    std::ifstream in{file};
    std::uint16_t number = 0;
    in >> std::hex >> number;
    return number;
}

} // namespace

std::vector<std::string> configured_names()
{
    for (const fs::path& folder : configuration_folders()) {
        std::vector<std::string> names;
        std::error_code error;
        for (const auto& entry : fs::directory_iterator{folder, error}) {
            if (entry.path().extension() == ".config") names.push_back(entry.path().stem());
        }
        std::sort(names.begin(), names.end());
        if (!names.empty()) return names;
    }
    return {};
}

std::vector<std::string> models_on_usb()
{
    std::vector<std::string> models;
    std::error_code error;
    for (const auto& entry : fs::directory_iterator{"/sys/bus/usb/devices", error}) {
        const auto* const id = find_usb_id(usb_number_in(entry.path() / "idVendor"),
                                           usb_number_in(entry.path() / "idProduct"));
        if (id == nullptr || id->kind != UsbKind::touch) continue;
        models.push_back(fmt::format("{} (USB {:04x}:{:04x})", id->name, id->vendor, id->product));
    }
    return models;
}

} // namespace hapnet::device::hdapi
