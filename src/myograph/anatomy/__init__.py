"""What an arm is: bones, hinge, muscles, their lines of action and bodies; the built-in left arm."""
