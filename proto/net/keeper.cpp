// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/net/keeper.hpp"

#include "proto/disk/result_file.hpp"

#include <spdlog/fmt/fmt.h>
#include <system_error>
#include <unistd.h>
#include <utility>

namespace hapnet::net {

base::Result<std::string> Keeper::order(const std::string& file, base::TimePoint from)
{
    if (files_ >= files_max) {
        return base::fail(fmt::format("{} files were saved already: a run saves no more", files_));
    }
    std::string path = folder_ + "/" + file;
    if (access(path.c_str(), F_OK) == 0) {
        return base::fail(fmt::format("{} is there already: choose another name", path));
    }
    const std::scoped_lock guard{lock_};
    if (waiting_) return base::fail("another file is being saved: ask again");
    waiting_ = Order{path, from};
    ++files_;
    return path;
}

std::optional<Keeper::Order> Keeper::take()
{
    const std::scoped_lock guard{lock_};
    return std::exchange(waiting_, std::nullopt);
}

void Keeper::save(const std::string& path, std::string_view bytes)
{
    try {
        disk::ResultFile{path, "", 0600}.commit(bytes);
    } catch (const std::system_error& error) {
        const std::scoped_lock guard{lock_};
        trouble_ = error.what();
    }
}

std::optional<std::string> Keeper::trouble()
{
    const std::scoped_lock guard{lock_};
    return std::exchange(trouble_, std::nullopt);
}

} // namespace hapnet::net
