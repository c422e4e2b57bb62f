# SPDX-FileCopyrightText: 2026 The Hapnet authors
# SPDX-License-Identifier: MIT
# Leaves out the comments of a script, style sheet or page that stand on lines of their own, those
# behind code that have no quote, and what indents lines: no text of our scripts goes over two.
/^[[:space:]]*<!--.*-->$/d
/^[[:space:]]*\/\//d
/^[[:space:]]*\/\*.*\*\/[[:space:]]*$/d
/^[[:space:]]*\/\*/,/\*\//d
/^[[:space:]]*$/d
s/^[[:space:]]*//
s/[[:space:]]\{1,\}\/\/ [^"'`]*$//
