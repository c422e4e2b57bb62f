// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/record/writer.hpp"

#include "proto/record/codec.hpp"
#include "proto/record/header.hpp"

#include <cerrno>
#include <spdlog/fmt/fmt.h>
#include <system_error>
#include <utility>

namespace hapnet::record {

Writer::Writer(std::string path, const nlohmann::json& config)
    : path_{std::move(path)}, file_{std::fopen(path_.c_str(), "wbe")}
{
    if (!file_) refuse("create");
    const std::string header = header_line(config) + '\n';
    put(header.data(), header.size());
    flush();
}

void Writer::write(const Row& row)
{
    const RowBytes bytes = encode(row);
    put(bytes.data(), bytes.size());
}

void Writer::flush()
{
    if (std::fflush(file_.get()) != 0) refuse("write");
}

void Writer::put(const void* data, std::size_t size)
{
    if (std::fwrite(data, 1, size, file_.get()) != size) refuse("write");
}

void Writer::refuse(const char* what) const
{
    throw std::system_error{errno, std::generic_category(),
                            fmt::format("cannot {} the record {}", what, path_)};
}

} // namespace hapnet::record
