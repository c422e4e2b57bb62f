// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "device/hdapi/transport/configuration.hpp"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string_view>

namespace hapnet::device::hdapi {

namespace {

namespace fs = std::filesystem;

std::string variable(const char* name)
{
    const char* value = std::getenv(name);
    return value == nullptr ? "" : value;
}

/// Where guides of the vendor and of others have it; the first that is there counts.
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

std::string first_word_in(const fs::path& file)
{
    std::ifstream in{file};
    std::string word;
    in >> word;
    return word;
}

} // namespace

std::vector<std::string> configured_names()
{
    for (const fs::path& folder : configuration_folders()) {
        std::vector<std::string> names;
        std::error_code trouble;
        for (const auto& entry : fs::directory_iterator{folder, trouble}) {
            if (entry.path().extension() == ".config") names.push_back(entry.path().stem());
        }
        std::sort(names.begin(), names.end());
        if (!names.empty()) return names;
    }
    return {};
}

std::vector<std::string> models_on_usb()
{
    constexpr std::array<std::string_view, 3> known{"0301:2988", "2988:0302", "2988:0304"};
    std::vector<std::string> models;
    std::error_code trouble;
    for (const auto& entry : fs::directory_iterator{"/sys/bus/usb/devices", trouble}) {
        const std::string id = first_word_in(entry.path() / "idVendor") + ":" +
                               first_word_in(entry.path() / "idProduct");
        if (std::find(known.begin(), known.end(), id) == known.end()) continue;
        models.push_back("Touch (USB " + id + ")");
    }
    return models;
}

} // namespace hapnet::device::hdapi
