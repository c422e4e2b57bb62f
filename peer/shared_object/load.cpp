// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "peer/shared_object/load.hpp"

#include "peer/core/sync/text.hpp"
#include "proto/net/text_file.hpp"

#include <dlfcn.h>
#include <memory>
#include <spdlog/fmt/fmt.h>
#include <utility>

namespace hapnet::peer::shared_object {

namespace {

constexpr const char* entry = "hapnet_describe";

base::Result<Loaded> open(const std::string& file)
{
    if (file.empty()) {
        return base::fail("shared-object: says no file; write file = \"./FILE.so\"");
    }
    // A name without a slash would be searched for among the system's libraries.
    const std::string path = file.find('/') == std::string::npos ? "./" + file : file;
    const std::shared_ptr<void> library{dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL),
                                        [](void* opened) {
                                            if (opened != nullptr) dlclose(opened);
                                        }};
    if (!library) return base::fail(fmt::format("cannot load {}", dlerror()));
    using Entry = const hapnet_algorithm* (*)();
    // POSIX (dlsym) requires this conversion of the result.
    const auto described = reinterpret_cast<Entry>(dlsym(library.get(), entry)); // NOLINT
    const hapnet_algorithm* const algorithm = described == nullptr ? nullptr : described();
    if (algorithm == nullptr) {
        return base::fail(fmt::format("{}: exports no {}(), so it is no algorithm of "
                                      "hapnet/algorithm.h",
                                      file, entry));
    }
    return Loaded{library, algorithm};
}

} // namespace

base::Result<void> load(Algorithm& algorithm)
{
    const auto* const foreign = std::get_if<SharedObject>(&algorithm);
    if (foreign == nullptr || foreign->is_loaded()) return {};
    auto opened = open(foreign->options().file);
    if (!opened) return tl::unexpected{opened.error()};
    auto loaded = foreign->with(*std::move(opened));
    if (!loaded) {
        return base::fail(fmt::format("{}: {}", foreign->options().file, loaded.error().message));
    }
    algorithm = *std::move(loaded);
    return {};
}

base::Result<Algorithm> load_from_disk(const std::string& file_or_name)
{
    auto algorithm = load_algorithm(file_or_name, net::text_of_file);
    if (!algorithm) return algorithm;
    if (const auto loaded = load(*algorithm); !loaded) return tl::unexpected{loaded.error()};
    return algorithm;
}

} // namespace hapnet::peer::shared_object
