#pragma once

#include <string>

#include "core/options/option.h"

namespace winslow::gui::ui {

/// Fields for the options of a table; those that have no effect with what else is chosen are not
/// shown. The id of a field is PREFIX/KEY, of one within an object PREFIX/OBJECT_KEY. True if one
/// changed.
bool option_form(const std::string& prefix, const OptionTable& table);

}  // namespace winslow::gui::ui
