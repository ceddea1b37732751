# The comment at the top of a header becomes what Doxygen says of the file, as it stands: formulas and drawings keep their lines.
# Lines keep their numbers, so that a warning tells the place.
NR == 1 { print "/** \\file"; next }
!done && /^\/\// {
  sub(/^\/\/ ?/, "")
  gsub(/\*\//, "* /")
  if (NR == 2) printf "\\verbatim\n"
  else printf "\n"
  printf "%s", $0
  inside = 1
  next
}
!done { done = 1; print (inside ? "\n\\endverbatim */" : "*/") $0; next }
# What stands in angle brackets is a word for a value, not HTML.
match($0, /\/\/\/<?/) {
  code = substr($0, 1, RSTART + RLENGTH - 1)
  words = substr($0, RSTART + RLENGTH)
  gsub(/</, "\\<", words)
  print code words
  next
}
{ print }
