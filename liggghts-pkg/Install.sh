# SPDX-License-Identifier: GPL-2.0-or-later
# Puts the package into src of a LIGGGHTS source tree, whose subfolder it is there (USER-NURBS); run by
# `make yes-user-nurbs` (mode 1) and `make no-user-nurbs` (0), and by `make package-update` (2) if PACKUSER in that
# folder's Makefile names user-nurbs.
# NURBS=FOLDER in the environment: where this project's libraries are installed; default /usr/local.

mode=$1
settings=${NURBS:-/usr/local}/share/liggghts-nurbs/Makefile.nurbs

if [ "$mode" != 0 ] && [ ! -e "$settings" ]; then
  echo "USER-NURBS: there is no '$settings'; install the libraries first (cmake --install) and say where:" >&2
  echo "  make yes-user-nurbs NURBS=FOLDER" >&2
  exit 1
fi

for file in *.cpp *.h; do
  case $file in
    register_styles.* | liggghts_nurbs.cpp) continue ;; # of the plug-in: a source tree has its own tables and main
  esac
  if [ "$mode" = 0 ]; then
    rm -f "../$file"
  elif ! cmp -s "$file" "../$file"; then
    cp "$file" ..
    if [ "$mode" = 2 ]; then echo "  updating src/$file"; fi
  fi
done

if [ -e ../Makefile.package ]; then
  sed -i -e 's/\$(NURBS_[A-Z]*) //' -e '/^include .*Makefile\.nurbs$/d' ../Makefile.package
  if [ "$mode" != 0 ]; then
    for kind in INC PATH LIB; do
      sed -i -e "s|^PKG_$kind =[ \t]*|&\$(NURBS_$kind) |" ../Makefile.package
    done
    echo "include $settings" >>../Makefile.package
  fi
fi
