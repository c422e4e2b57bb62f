// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "device/transport/shared_library.hpp"

#include <dlfcn.h>

namespace hapnet::device {

namespace {

std::string last_complaint()
{
    const char* text = dlerror();
    return text == nullptr ? "no reason given" : text;
}

} // namespace

base::Result<SharedLibrary> SharedLibrary::load(const std::string& file,
                                                std::span<const char* const> usual_names)
{
    if (!file.empty()) {
        // For a name without a slash, dlopen() searches the system's folders.
        const std::string path = file.find('/') == std::string::npos ? "./" + file : file;
        if (void* library = dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL)) {
            return SharedLibrary{library};
        }
        return base::fail(last_complaint());
    }
    std::string complaint;
    for (const char* name : usual_names) {
        if (void* library = dlopen(name, RTLD_NOW | RTLD_LOCAL)) return SharedLibrary{library};
        if (complaint.empty()) complaint = last_complaint();
    }
    return base::fail(complaint);
}

void* SharedLibrary::symbol(const char* name) const { return dlsym(library_, name); }

} // namespace hapnet::device
