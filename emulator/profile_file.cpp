// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/profile_file.hpp"

#include "emulator/core/profile/text.hpp"

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <spdlog/fmt/fmt.h>

namespace hapnet::emulator {

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
    for (char c = 0; text.size() <= bytes_max && file.get(c);) text.push_back(c);
    if (text.size() > bytes_max) return refuse("it is larger than 64 MiB");
    if (file.bad()) return refuse(std::strerror(errno));
    return text;
}

std::string path_beside(const std::string& name, const std::string& beside)
{
    if (beside.empty()) return name;
    return (std::filesystem::path{beside}.parent_path() / name).string();
}

base::Result<Profile> load_profile(const std::string& file_or_name)
{
    const auto text = text_of_file(file_or_name);
    if (!text) return tl::unexpected{text.error()};
    return parse_profile(*text, file_or_name, [&](const std::string& name) {
        return text_of_file(path_beside(name, file_or_name));
    });
}

} // namespace hapnet::emulator
