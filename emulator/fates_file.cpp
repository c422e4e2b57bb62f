// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/fates_file.hpp"

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <spdlog/fmt/fmt.h>
#include <system_error>

namespace hapnet::emulator {

base::Result<Fates> read_fates(const std::string& path)
{
    std::error_code trouble;
    if (std::filesystem::is_directory(path, trouble)) {
        return base::fail(fmt::format("cannot read {}: it is a folder", path));
    }
    std::ifstream file{path, std::ios::binary};
    const std::string text{std::istreambuf_iterator<char>{file}, {}};
    if (!file) return base::fail(fmt::format("cannot read {}: {}", path, std::strerror(errno)));
    auto fates = parse_fates(text);
    if (!fates) return base::fail(fmt::format("{}: {}", path, fates.error().message));
    return fates;
}

} // namespace hapnet::emulator
