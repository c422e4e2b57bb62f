// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/result.hpp"

#include <span>
#include <string>

namespace hapnet::device {

/// A vendor's library, loaded when it is needed and never unloaded: drivers fail when they are
/// loaded a second time (observed by CHAI3D).
class SharedLibrary {
public:
    /// Loads `file`, or with "" the first of the usual names that the system finds. The error is
    /// the loader's message about the first one.
    [[nodiscard]] static base::Result<SharedLibrary> load(const std::string& file,
                                                          std::span<const char* const> usual_names);

    /// Sets the pointer to the function of this name. Remembers the name of the first function that
    /// is missing.
    template <typename Function>
    void find(Function*& function, const char* name)
    {
        function = reinterpret_cast<Function*>(symbol(name));
        if (function == nullptr && missing_.empty()) missing_ = name;
    }
    /// Returns the name of the first function that was not found; "": all were found.
    [[nodiscard]] const std::string& missing() const { return missing_; }

private:
    explicit SharedLibrary(void* library) : library_{library} {}
    [[nodiscard]] void* symbol(const char* name) const;

    void* library_;
    std::string missing_;
};

} // namespace hapnet::device
