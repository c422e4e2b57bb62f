// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/fates_file.hpp"

#include <cerrno>
#include <cstddef>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <spdlog/fmt/fmt.h>
#include <system_error>

namespace hapnet::emulator {

base::Result<FatesOfPaths> read_fates(const std::string& path)
{
    std::error_code trouble;
    if (std::filesystem::is_directory(path, trouble)) {
        return base::fail(fmt::format("cannot read {}: it is a folder", path));
    }
    std::ifstream file{path, std::ios::binary};
    if (!file) return base::fail(fmt::format("cannot read {}: {}", path, std::strerror(errno)));
    // Reads only the beginning, because anything but a file of fates may have no end.
    std::string text(fates_header.size(), '\0');
    text.resize(static_cast<std::size_t>(file.read(text.data(), std::ssize(text)).gcount()));
    bool is_known = false;
    for (const bool has_paths : {false, true}) {
        for (const bool has_flows : {false, true}) {
            for (const bool has_regimes : {false, true}) {
                const auto head = head_of_fates({has_paths, has_flows, has_regimes});
                is_known = is_known || head.starts_with(text);
            }
        }
    }
    if (is_known && text.size() == fates_header.size()) {
        text.append(std::istreambuf_iterator<char>{file}, {});
    } else if (file) {
        text += '\n';
    }
    auto fates = parse_fates_of_paths(text);
    if (!fates) return base::fail(fmt::format("{}: {}", path, fates.error().message));
    return fates;
}

} // namespace hapnet::emulator
