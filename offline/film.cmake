# SPDX-License-Identifier: Apache-2.0
# What samples add up to, and its file.
luciole_room(film
  SOURCES film/film.cpp film/film_file.cpp
  LINK luciole_base luciole_image)

luciole_test(film_test SOURCES film/film_test.cpp film/film_file_test.cpp LINK luciole_film)
