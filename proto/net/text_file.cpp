// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/net/text_file.hpp"

#include <array>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <spdlog/fmt/fmt.h>
#include <system_error>

namespace hapnet::net {

base::Result<std::string> text_of_file(const std::string& path)
{
    constexpr std::uintmax_t bytes_max = 64U << 20;
    const auto refuse = [&](const char* why) {
        return base::fail(fmt::format("cannot read {}: {}", path, why));
    };
    std::error_code trouble;
    if (std::filesystem::is_directory(path, trouble)) return refuse("it is a folder");
    const auto size = std::filesystem::file_size(path, trouble);
    if (!trouble && size > bytes_max) return refuse("it is larger than 64 MiB");
    std::ifstream file{path, std::ios::binary};
    if (!file) return refuse(std::strerror(errno));
    std::string text;
    // NOLINTNEXTLINE(*-member-init): only what is read is used
    std::array<char, std::size_t{64} << 10> block;
    while (text.size() <= bytes_max && file) {
        file.read(block.data(), block.size());
        text.append(block.data(), static_cast<std::size_t>(file.gcount()));
    }
    if (text.size() > bytes_max) return refuse("it is larger than 64 MiB");
    if (file.bad()) return refuse(std::strerror(errno));
    return text;
}

} // namespace hapnet::net
