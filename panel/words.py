"""The words of panel_node."""
import sys
import xml.etree.ElementTree


def answer_words(name, help_text, package):
    """Answers --help and --version, and refuses every other word that is not for ROS itself (NAME:=VALUE)."""
    for word in sys.argv[1:]:
        if ':=' in word:
            continue
        if word == '--version':
            print(xml.etree.ElementTree.parse(package).findtext('version'))
        elif word in ('--help', '-h'):
            print('usage: rosrun knot_utm %s [NAME:=VALUE]...\n\n%s' % (name, help_text.strip()))
        else:
            print('%s: it takes no "%s" (%s --help)' % (name, word, name), file=sys.stderr)
            sys.exit(2)
        sys.exit(0)
