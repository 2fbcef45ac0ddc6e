// What surrounds the content of the page: style sheet and script.
#pragma once

namespace collision::report {

/// From the doctype to the begin of the body.
extern const char kPageHead[];

/// The script, and the end of the body. The script unfolds what a link leads to, and unfolds all
/// for the button and for printing.
extern const char kPageEnd[];

}  // namespace collision::report
