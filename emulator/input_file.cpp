// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/input_file.hpp"

#include <filesystem>
#include <fstream>
#include <spdlog/fmt/fmt.h>
#include <system_error>

namespace hapnet::emulator {

base::Result<std::string> read_input_file(const std::string& path)
{
    std::error_code error;
    const auto status = std::filesystem::status(path, error);
    if (status.type() == std::filesystem::file_type::not_found) {
        return base::fail(fmt::format("there is no file {}", path));
    }
    if (!std::filesystem::is_regular_file(status)) {
        return base::fail(fmt::format("{} is no file that can be read", path));
    }
    const auto bytes = std::filesystem::file_size(path, error);
    if (error || bytes > input_bytes_max) {
        return base::fail(fmt::format("{} has more than {} bytes", path, input_bytes_max));
    }
    std::string text(bytes, '\0');
    std::ifstream stream{path, std::ios::binary};
    if (!stream.read(text.data(), static_cast<std::streamsize>(bytes))) {
        return base::fail(fmt::format("{} cannot be read", path));
    }
    return text;
}

base::Result<std::string> read_input_file(const std::string& name, const std::string& beside)
{
    return read_input_file((std::filesystem::path{beside}.parent_path() / name).string());
}

} // namespace hapnet::emulator
