// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
// The main() of test programs with emulated devices. umockdev works only if its library is loaded
// first, so the program restarts itself with it.
#include <cstdio>
#include <cstdlib>
#include <gtest/gtest.h>
#include <string>
#include <unistd.h>

namespace {

constexpr const char* preloaded = "libumockdev-preload.so.0";

/// Puts `first` in front of the words of an environment variable.
void prepend(const char* variable, const std::string& first, char separator)
{
    const char* const before = std::getenv(variable);
    const bool is_empty = before == nullptr || *before == '\0';
    setenv(variable, (is_empty ? first : first + separator + before).c_str(), 1);
}

bool is_preloaded()
{
    const char* const libraries = std::getenv("LD_PRELOAD");
    return libraries != nullptr && std::string{libraries}.find(preloaded) != std::string::npos;
}

} // namespace

// The libraries under umockdev lock by means that ThreadSanitizer does not see. They call pass_read
// and the like on their own thread, which runs nothing but the emulated device.
// NOLINTNEXTLINE(bugprone-reserved-identifier): its name for it
extern "C" const char* __tsan_default_suppressions();
// NOLINTNEXTLINE(bugprone-reserved-identifier)
extern "C" const char* __tsan_default_suppressions()
{
    return "called_from_lib:libumockdev.so.0\n"
           "called_from_lib:libglib-2.0.so.0\n"
           "called_from_lib:libgobject-2.0.so.0\n"
           "called_from_lib:libgio-2.0.so.0\n"
           "race:hapnet::umockdev::(anonymous namespace)::pass_\n";
}

int main(int count, char** words)
{
    if (!is_preloaded()) {
        prepend("LD_PRELOAD", preloaded, ':');
        // AddressSanitizer wants to be the first library, but now umockdev is.
        prepend("ASAN_OPTIONS", "verify_asan_link_order=0", ':');
        // ThreadSanitizer did not instrument GLib, so it does not see GLib's locks.
        prepend("TSAN_OPTIONS", "ignore_noninstrumented_modules=1", ':');
        execv("/proc/self/exe", words);
        std::perror("cannot start again under umockdev");
        return 1;
    }
    ::testing::InitGoogleTest(&count, words);
    return RUN_ALL_TESTS();
}
