// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef LMP_WALL_NURBS_SETTING_H
#define LMP_WALL_NURBS_SETTING_H

namespace liggghts_pkg {

/// Another value of something that is LIGGGHTS', as long as this stands.
template <class T>
class Setting {
 public:
  Setting(T& place, T value) : place_(place), before_(place) { place_ = value; }
  ~Setting() { place_ = before_; }
  Setting(const Setting&) = delete;
  Setting& operator=(const Setting&) = delete;

 private:
  T& place_;
  T before_;
};

}  // namespace liggghts_pkg

#endif
