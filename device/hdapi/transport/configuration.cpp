// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "device/hdapi/transport/configuration.hpp"

#include <algorithm>
#include <cstdlib>
#include <filesystem>

namespace hapnet::device::hdapi {

namespace {

namespace fs = std::filesystem;

std::string variable(const char* name)
{
    const char* value = std::getenv(name);
    return value == nullptr ? "" : value;
}

/// Returns the folders that guides of the vendor and of others name. The first one that exists is
/// used.
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

} // namespace hapnet::device::hdapi
