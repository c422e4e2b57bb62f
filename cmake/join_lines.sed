# SPDX-FileCopyrightText: 2026 The Hapnet authors
# SPDX-License-Identifier: MIT
# Of a whole file without the comments on lines of their own: joins lines where code goes on, and
# leaves out spaces around operators that no text of ours has.
s/\([,;({[]\)\n/\1/g
s/ \(=>\|===\|!==\|&&\|||\|??\) /\1/g
s/\([])}[:alnum:]_]\) = \([^]["`$–]\)/\1=\2/g
